#include "validation/options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <variant>

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

template <class Value>
Value choice(const std::string& name, const std::string& text, const std::map<std::string, Value>& values) {
  std::string allowed;
  for (const auto& [word, value] : values) {
    if (word == text) {
      return value;
    }
    allowed += (allowed.empty() ? "" : " or ") + word;
  }
  throw std::invalid_argument(name + "=" + text + ": is not known; give " + allowed + ".");
}

/// Throws std::invalid_argument for a frame.
RegularLattice& cells_of(SceneSpec& spec) {
  auto* lattice = std::get_if<RegularLattice>(&spec.lattice);
  if (lattice == nullptr) throw std::invalid_argument("columns, rows: a frame has none.");
  return *lattice;
}

const std::vector<Option>& all_options() {
  static const std::vector<Option> kOptions = {
      {"speed", "speed of the impact plate, m/s",
       [](Options& o, const std::string& v) { o.spec.loading.speed_m_per_s = number_of("speed", v); }},
      {"end_strain", "nominal strain at which the run ends",
       [](Options& o, const std::string& v) { o.spec.loading.end_strain = number_of("end_strain", v); }},
      {"direction", "of the crush, x or y",
       [](Options& o, const std::string& v) {
         using Direction = LoadingSpec::Direction;
         o.spec.loading.direction = choice<Direction>("direction", v, {{"x", Direction::x}, {"y", Direction::y}});
       }},
      {"columns", "of cells",
       [](Options& o, const std::string& v) { cells_of(o.spec).columns = count_of("columns", v); }},
      {"rows", "of cells", [](Options& o, const std::string& v) { cells_of(o.spec).rows = count_of("rows", v); }},
      {"elements", "elements a wall",
       [](Options& o, const std::string& v) { o.spec.elements_per_wall = count_of("elements", v); }},
      {"formulation", "force_based or displacement_based",
       [](Options& o, const std::string& v) {
         using Formulation = SectionSpec::Formulation;
         o.spec.section.formulation = choice<Formulation>(
             "formulation", v,
             {{"force_based", Formulation::force_based}, {"displacement_based", Formulation::displacement_based}});
       }},
      {"depth_rule", "full_moment or lobatto",
       [](Options& o, const std::string& v) {
         using DepthRule = SectionSpec::DepthRule;
         o.spec.section.depth_rule = choice<DepthRule>(
             "depth_rule", v, {{"full_moment", DepthRule::full_moment}, {"lobatto", DepthRule::lobatto}});
       }},
      {"area", "constant_volume or constant_area",
       [](Options& o, const std::string& v) {
         using Area = SectionSpec::AreaRule;
         o.spec.section.area_rule = choice<Area>(
             "area", v, {{"constant_volume", Area::constant_volume}, {"constant_area", Area::constant_area}});
       }},
      {"inclusions", "rigid or meshed",
       [](Options& o, const std::string& v) {
         using Model = Inclusions::Model;
         o.spec.inclusions.model = choice<Model>("inclusions", v, {{"rigid", Model::rigid}, {"meshed", Model::meshed}});
       }},
      {"plane", "stress or strain",
       [](Options& o, const std::string& v) {
         using Plane = MaterialSpec::Plane;
         o.spec.material.plane = choice<Plane>("plane", v, {{"stress", Plane::stress}, {"strain", Plane::strain}});
       }},
      {"axial_points", "sections along an element",
       [](Options& o, const std::string& v) { o.spec.section.axial_points = count_of("axial_points", v); }},
      {"depth_points", "fibres through the depth",
       [](Options& o, const std::string& v) { o.spec.section.depth_points = count_of("depth_points", v); }},
      {"seed", "of the imperfection",
       [](Options& o, const std::string& v) { o.spec.imperfection.seed = count_of("seed", v); }},
      {"amplitude", "of the imperfection, mm",
       [](Options& o, const std::string& v) { o.spec.imperfection.amplitude_mm = number_of("amplitude", v); }},
      {"bow", "of the walls, mm",
       [](Options& o, const std::string& v) { o.spec.imperfection.bow_mm = number_of("bow", v); }},
      {"time_step", "s; 0: chosen",
       [](Options& o, const std::string& v) { o.spec.numerics.time_step_s = number_of("time_step", v); }},
      {"step_factor", "of the step that is given or chosen",
       [](Options& o, const std::string& v) { o.step_factor = number_of("step_factor", v); }},
      {"mass_damping", "1/s",
       [](Options& o, const std::string& v) { o.spec.numerics.mass_damping_per_s = number_of("mass_damping", v); }},
      {"mass_scaling", "fictitious masses",
       [](Options& o, const std::string& v) { o.spec.numerics.mass_scaling = number_of("mass_scaling", v); }},
      {"rotary_scaling", "fictitious rotary inertias",
       [](Options& o, const std::string& v) { o.spec.numerics.rotary_scaling = number_of("rotary_scaling", v); }},
      {"fibre_precision", "single or double",
       [](Options& o, const std::string& v) {
         using Precision = NumericsSpec::FibrePrecision;
         o.spec.numerics.fibre_precision = choice<Precision>(
             "fibre_precision", v, {{"single", Precision::single_precision}, {"double", Precision::double_precision}});
       }},
      {"contact_stiffness", "k in m_min / dt_crit^2",
       [](Options& o, const std::string& v) { o.spec.contact.stiffness_factor = number_of("contact_stiffness", v); }},
      {"contact_damping", "share of critical damping",
       [](Options& o, const std::string& v) { o.spec.contact.damping_ratio = number_of("contact_damping", v); }},
      {"plate_friction", "Coulomb's coefficient at the plates",
       [](Options& o, const std::string& v) { o.spec.plates.friction = number_of("plate_friction", v); }},
      {"search", "faces or buckets",
       [](Options& o, const std::string& v) {
         using Search = ContactSpec::Search;
         o.spec.contact.search = choice<Search>("search", v, {{"faces", Search::faces}, {"buckets", Search::buckets}});
       }},
      {"yield_stress", "MPa",
       [](Options& o, const std::string& v) { o.spec.material.yield_stress_mpa = number_of("yield_stress", v); }},
      {"hardening", "modulus, MPa",
       [](Options& o, const std::string& v) { o.spec.material.hardening_modulus_mpa = number_of("hardening", v); }},
      {"samples", "of the curve",
       [](Options& o, const std::string& v) { o.spec.output.sample_count = count_of("samples", v); }},
      {"frame_count", "frames of the lattice that are taken",
       [](Options& o, const std::string& v) { o.spec.output.frame_count = count_of("frame_count", v); }},
      {"until", "strain at which the run is broken off, samples and frames being those of the whole run",
       [](Options& o, const std::string& v) { o.until = number_of("until", v); }},
      {"simd", "kernel to use, one that the processor has",
       [](Options& o, const std::string& v) { o.simd_target = v; }},
      {"table", "CSV file to which a row of results is appended",
       [](Options& o, const std::string& v) { o.table_file = v; }},
      {"curve", "CSV file of the stress-strain curve", [](Options& o, const std::string& v) { o.curve_file = v; }},
      {"frames", "file of the lattice's frames, of which validation_pictures draws strips",
       [](Options& o, const std::string& v) { o.frames_file = v; }},
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
