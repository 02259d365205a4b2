#include "validation/options.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <stdexcept>
#include <variant>

#include "cellcrush/lattice_words.h"
#include "cellcrush/simulation.h"
#include "scenes/presets.h"

namespace cellcrush::validation {
namespace {

struct Option {
  std::string name;
  std::string meaning;
  std::function<void(Options&, const std::string&)> apply;
};

double number_of(const std::string& name, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    throw std::invalid_argument(name + "=" + text + ": is no number; give one such as " + name + "=2.");
  }
  return value;
}

int count_of(const std::string& name, const std::string& text) {
  const double value = number_of(name, text);
  if (value < 0.0 || value > 1e9 || value != std::floor(value)) {
    throw std::invalid_argument(name + "=" + text + ": is no count; give a whole number from 0.");
  }
  return static_cast<int>(value);
}

/// A field of a part of the spec.
template <class Part, class Field>
auto in(Part SceneSpec::*part, Field Part::*field) {
  return [=](Options& options) -> Field& { return options.spec.*part.*field; };
}

/// A field of the lattice; throws std::invalid_argument for a frame.
template <class Field>
auto in_cells(Field RegularLattice::*field) {
  return [=](Options& options) -> Field& {
    auto* lattice = std::get_if<RegularLattice>(&options.spec.lattice);
    if (lattice == nullptr)
      throw std::invalid_argument("kind, columns, rows, side, thickness: of a lattice of equal cells only.");
    return lattice->*field;
  };
}

template <class Field>
auto in_options(Field Options::*field) {
  return [=](Options& options) -> Field& { return options.*field; };
}

template <class Access>
Option number(const char* name, const char* meaning, Access access) {
  return {name, meaning, [=](Options& options, const std::string& text) { access(options) = number_of(name, text); }};
}

template <class Access>
Option count(const char* name, const char* meaning, Access access) {
  return {name, meaning, [=](Options& options, const std::string& text) { access(options) = count_of(name, text); }};
}

Option word(const char* name, const char* meaning, std::string Options::*field) {
  return {name, meaning, [=](Options& options, const std::string& text) { options.*field = text; }};
}

template <class Part, class Value>
Option choice(const std::string& name, Part SceneSpec::*part, Value Part::*field,
              const std::map<std::string, Value>& values) {
  std::string allowed;
  for (const auto& [text, value] : values) allowed += (allowed.empty() ? "" : " or ") + text;
  return {name, allowed, [=](Options& options, const std::string& text) {
            const auto found = values.find(text);
            if (found == values.end()) {
              throw std::invalid_argument(name + "=" + text + ": is not known; give " + allowed + ".");
            }
            options.spec.*part.*field = found->second;
          }};
}

const std::vector<Option>& all_options() {
  using S = SceneSpec;
  using Direction = LoadingSpec::Direction;
  using Formulation = SectionSpec::Formulation;
  using DepthRule = SectionSpec::DepthRule;
  using Area = SectionSpec::AreaRule;
  using Model = Inclusions::Model;
  using Plane = MaterialSpec::Plane;
  using Precision = NumericsSpec::FibrePrecision;
  using Search = ContactSpec::Search;
  static const std::vector<Option> kOptions = {
      number("speed", "speed of the impact plate, m/s", in(&S::loading, &LoadingSpec::speed_m_per_s)),
      number("end_strain", "nominal strain at which the run ends", in(&S::loading, &LoadingSpec::end_strain)),
      choice("direction", &S::loading, &LoadingSpec::direction, {{"x", Direction::x}, {"y", Direction::y}}),
      {"kind", "of cells in place of those of the preset: a kind of lattice, such as kagome",
       [](Options& options, const std::string& text) {
         const auto names = lattice_names();
         if (std::ranges::find(names, text) == names.end()) {
           throw std::invalid_argument("kind=" + text + ": is no lattice; give one such as kind=kagome.");
         }
         auto& lattice = in_cells(&RegularLattice::kind)(options);
         lattice = text;
         std::get<RegularLattice>(options.spec.lattice).own.clear();
       }},
      count("columns", "of cells", in_cells(&RegularLattice::columns)),
      count("rows", "of cells", in_cells(&RegularLattice::rows)),
      number("side", "of the cells, mm", in_cells(&RegularLattice::side_mm)),
      number("thickness", "of the walls, mm", in_cells(&RegularLattice::wall_thickness_mm)),
      count(
          "elements", "elements a wall", [](Options & o) -> auto& { return o.spec.elements_per_wall; }),
      choice("formulation", &S::section, &SectionSpec::formulation,
             {{"force_based", Formulation::force_based}, {"displacement_based", Formulation::displacement_based}}),
      choice("depth_rule", &S::section, &SectionSpec::depth_rule,
             {{"full_moment", DepthRule::full_moment}, {"lobatto", DepthRule::lobatto}}),
      choice("area", &S::section, &SectionSpec::area_rule,
             {{"constant_volume", Area::constant_volume}, {"constant_area", Area::constant_area}}),
      choice("inclusions", &S::inclusions, &Inclusions::model, {{"rigid", Model::rigid}, {"meshed", Model::meshed}}),
      choice("plane", &S::material, &MaterialSpec::plane,
             {{"stress", Plane::stress}, {"strain", Plane::strain}, {"strip", Plane::strip}}),
      count("axial_points", "sections along an element", in(&S::section, &SectionSpec::axial_points)),
      count("depth_points", "fibres through the depth", in(&S::section, &SectionSpec::depth_points)),
      {"seed", "of the imperfection, and of the nuclei of a Voronoi honeycomb",
       [](Options& options, const std::string& text) {
         options.spec.imperfection.seed = static_cast<std::uint64_t>(count_of("seed", text));
         if (auto* voronoi = std::get_if<VoronoiWalls>(&options.spec.lattice))
           voronoi->seed = options.spec.imperfection.seed;
       }},
      {"irregularity", "of a Voronoi honeycomb",
       [](Options& options, const std::string& text) {
         auto* voronoi = std::get_if<VoronoiWalls>(&options.spec.lattice);
         if (voronoi == nullptr) throw std::invalid_argument("irregularity: only a Voronoi honeycomb has one.");
         voronoi->irregularity = number_of("irregularity", text);
       }},
      {"thickness_at_impact", "share of the mean thickness, from which it changes linearly along x",
       [](Options& options, const std::string& text) {
         const double first = number_of("thickness_at_impact", text);
         options.spec.changes.grading.thickness_polynomial = {first, 2.0 - 2.0 * first};
       }},
      number("amplitude", "of the imperfection, mm", in(&S::imperfection, &Imperfection::amplitude_mm)),
      number("bow", "of the walls, mm", in(&S::imperfection, &Imperfection::bow_mm)),
      number("time_step", "s; 0: chosen", in(&S::numerics, &NumericsSpec::time_step_s)),
      number("step_factor", "of the step that is given or chosen", in_options(&Options::step_factor)),
      number("mass_damping", "1/s", in(&S::numerics, &NumericsSpec::mass_damping_per_s)),
      number("mass_scaling", "fictitious masses", in(&S::numerics, &NumericsSpec::mass_scaling)),
      number("rotary_scaling", "fictitious rotary inertias", in(&S::numerics, &NumericsSpec::rotary_scaling)),
      choice("fibre_precision", &S::numerics, &NumericsSpec::fibre_precision,
             {{"single", Precision::single_precision}, {"double", Precision::double_precision}}),
      number("contact_stiffness", "k in m_min / dt_crit^2", in(&S::contact, &ContactSpec::stiffness_factor)),
      number("contact_damping", "share of critical damping", in(&S::contact, &ContactSpec::damping_ratio)),
      number("plate_friction", "Coulomb's coefficient at the plates", in(&S::plates, &PlatesSpec::friction)),
      choice("search", &S::contact, &ContactSpec::search, {{"faces", Search::faces}, {"buckets", Search::buckets}}),
      number("yield_stress", "MPa", in(&S::material, &MaterialSpec::yield_stress_mpa)),
      number("hardening", "modulus, MPa",
             [](Options& options) -> double& { return options.spec.material.hardening_modulus_mpa; }),
      count("samples", "of the curve", in(&S::output, &OutputSpec::sample_count)),
      count("frame_count", "frames of the lattice that are taken", in(&S::output, &OutputSpec::frame_count)),
      number("until", "strain at which the run is broken off, samples and frames being those of the whole run",
             in_options(&Options::until)),
      word("simd", "kernel to use, one that the processor has", &Options::simd_target),
      word("table", "CSV file to which a row of results is appended", &Options::table_file),
      word("curve", "CSV file of the stress-strain curve", &Options::curve_file),
      word("frames", "file of the lattice's frames, of which validation_pictures draws strips", &Options::frames_file),
  };
  return kOptions;
}

const Option& option_named(const std::string& name) {
  for (const Option& option : all_options()) {
    if (option.name == name) {
      return option;
    }
  }
  throw std::invalid_argument(name + ": is no option. The options are\n" + describe_options());
}

/// What says where to write and by which kernel, not what to crush.
bool changes_no_crush(const std::string& name) {
  return name == "table" || name == "curve" || name == "frames" || name == "simd";
}

void apply_word(Options& options, const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) {
    throw std::invalid_argument(word + ": is not of the form name=value.");
  }
  const std::string name = word.substr(0, equals);
  option_named(name).apply(options, word.substr(equals + 1));
  if (!changes_no_crush(name)) {
    options.changes += (options.changes.empty() ? "" : " ") + word;
  }
}

}  // namespace

Options read_options(const std::vector<std::string>& words) {
  const auto known = std::ranges::find(scenes::presets(), words.empty() ? "" : words.front(), &scenes::NamedSpec::name);
  if (known == scenes::presets().end()) {
    std::string names;
    for (const auto& preset : scenes::presets()) {
      names += "\n  " + preset.name;
    }
    throw std::invalid_argument((words.empty() ? "No preset is given" : words.front() + ": is no preset") +
                                ". The presets are" + names);
  }
  Options options;
  options.preset = known->name;
  options.spec = known->spec;
  for (std::size_t i = 1; i < words.size(); ++i) {
    apply_word(options, words[i]);
  }
  // A spec with problems has no step; run_crush tells them.
  if (options.step_factor != 1.0) {
    if (const SceneResult result = build_scene(options.spec); result.scene) {
      options.spec.numerics.time_step_s = options.step_factor * facts_of(*result.scene).time_step;
    }
  }
  return options;
}

std::string describe_options() {
  std::string text;
  for (const Option& option : all_options()) {
    text += "  " + option.name + "=...  " + option.meaning + "\n";
  }
  return text;
}

}  // namespace cellcrush::validation
