#include "scene/unit_sets.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fields/field_checker.h"
#include "lattice/lattice.h"

namespace cellcrush {
namespace {

/// Units in which people write cases, as factors to mm, MPa, kg/m^3 and m/s.
struct UnitSet {
  const char* name;
  double length;
  double stress;
  double density;
  double speed;
};

constexpr UnitSet kUnitSets[] = {
    {"mm, N, s and tonne/mm^3", 1.0, 1.0, 1e12, 1e-3},
    {"mm, MPa and kg/mm^3", 1.0, 1.0, 1e9, 1.0},
    {"mm, kN, ms and kg/mm^3, with GPa", 1.0, 1e3, 1e9, 1.0},
    {"mm, GPa and g/cm^3", 1.0, 1e3, 1e3, 1.0},
    {"mm, MPa and g/cm^3", 1.0, 1.0, 1e3, 1.0},
    {"mm, MPa and g/mm^3", 1.0, 1.0, 1e6, 1.0},
    {"mm, GPa and kg/m^3", 1.0, 1e3, 1.0, 1.0},
    {"m, Pa and kg/m^3 (SI)", 1e3, 1e-6, 1.0, 1.0},
    {"m, MPa and kg/m^3", 1e3, 1.0, 1.0, 1.0},
    {"mm, Pa and kg/m^3", 1.0, 1e-6, 1.0, 1.0},
    {"cm, N/cm^2 and g/cm^3", 10.0, 1e-2, 1e3, 1e-2},
    {"cm, N/cm^2 and kg/cm^3", 10.0, 1e-2, 1e6, 1e-2},
    {"cm, N, s and N s^2/cm^4", 10.0, 1e-2, 1e8, 1e-2},
};

/// What tells the units of a case.
struct Evidence {
  std::string material_path;
  double modulus = 0.0;    ///< MPa, if the units are those of the fields
  double yield = 0.0;      ///< MPa
  double density = 0.0;    ///< kg/m^3
  double thickness = 0.0;  ///< mm, of the thinnest wall; 0 if there is none
};

constexpr UnitSet kOfFields = {"mm, MPa and kg/m^3", 1.0, 1.0, 1.0, 1.0};

/// Walls of cellular solids, mm: from films to timber frames.
constexpr double kThinnestWall = 5e-4;
constexpr double kThickestWall = 100.0;
constexpr double kUsualWall = 0.2;
/// Elastic waves in bars, m/s: from lead to diamond.
constexpr double kSlowestWave = 300.0;
constexpr double kFastestWave = 18000.0;

double wave_speed(const Evidence& evidence, const UnitSet& units) {
  return std::sqrt(1e6 * units.stress * evidence.modulus / (units.density * evidence.density));
}

bool has_sound_wave(const Evidence& evidence, const UnitSet& units) {
  const double speed = wave_speed(evidence, units);
  return speed >= kSlowestWave && speed <= kFastestWave;
}

bool has_sound_material(const Evidence& evidence, const UnitSet& units) {
  const double modulus = units.stress * evidence.modulus;
  const double density = units.density * evidence.density;
  const double yield_strain = evidence.yield / evidence.modulus;
  return modulus >= kSoftest && modulus <= kStiffest && density >= kLightest && density <= kHeaviest &&
         yield_strain >= kLeastYield && yield_strain <= kGreatestYield && has_sound_wave(evidence, units);
}

bool has_sound_walls(const Evidence& evidence, const UnitSet& units) {
  const double thickness = units.length * evidence.thickness;
  return evidence.thickness == 0.0 || (thickness >= kThinnestWall && thickness <= kThickestWall);
}

bool is_sound(const Evidence& evidence, const UnitSet& units) {
  return has_sound_material(evidence, units) && has_sound_walls(evidence, units);
}

double thinnest_wall_of(const SceneSpec& spec) {
  if (const auto* frame = std::get_if<FrameWalls>(&spec.lattice)) {
    return frame->beams.empty() ? 0.0
                                : std::ranges::min(frame->beams, {}, &FrameWalls::Beam::thickness_mm).thickness_mm;
  }
  if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    return network->thicknesses_mm.empty() ? network->wall_thickness_mm.value_or(0.0)
                                           : std::ranges::min(network->thicknesses_mm);
  }
  if (const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice)) return voronoi->wall_thickness_mm.value_or(0.0);
  const RegularLattice* lattice = regular_lattice_of(spec);
  return lattice == nullptr ? 0.0 : lattice->wall_thickness_mm.value_or(0.0);
}

/// Nothing if a number is missing.
std::optional<Evidence> evidence_of(const SceneSpec& spec) {
  const MaterialSpec* material = &spec.material;
  std::string path = "material.";
  const auto* frame = std::get_if<FrameWalls>(&spec.lattice);
  if (!material->youngs_modulus_mpa && frame != nullptr && !frame->beams.empty() && frame->beams.front().material) {
    material = &*frame->beams.front().material;
    path = "lattice.frame.beams[0].material.";
  }
  const auto is_positive = [](std::optional<double> value) { return value && *value > 0.0 && std::isfinite(*value); };
  if (!is_positive(material->youngs_modulus_mpa) || !is_positive(material->yield_stress_mpa) ||
      !is_positive(material->density_kg_per_m3)) {
    return std::nullopt;
  }
  const double thickness = thinnest_wall_of(spec);
  return Evidence{path, *material->youngs_modulus_mpa, *material->yield_stress_mpa, *material->density_kg_per_m3,
                  is_positive(thickness) ? thickness : 0.0};
}

/// Of the sets in which all is sound, the one in which the walls are nearest to usual ones; the first of several.
const UnitSet* find_set(const Evidence& evidence) {
  const UnitSet* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const UnitSet& units : kUnitSets) {
    if (!is_sound(evidence, units)) continue;
    const double distance =
        evidence.thickness == 0.0 ? 0.0 : std::abs(std::log(units.length * evidence.thickness / kUsualWall));
    if (distance < least) {
      best = &units;
      least = distance;
    }
  }
  return best;
}

/// A converted number, by default without the round-off of its factor.
std::string converted(double value, int digits = 10) {
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  double rounded = value;
  std::from_chars(buffer.data(), end.ptr, rounded);
  return to_text(rounded);
}

/// "material.youngs_modulus_mpa as 69000 MPa": the fields that other units change.
std::vector<std::string> conversions(const SceneSpec& spec, const Evidence& evidence, const UnitSet& units) {
  std::vector<std::string> texts;
  const auto add = [&](const std::string& field, double value, double factor, const char* unit) {
    if (factor != 1.0) texts.push_back(field + " as " + converted(factor * value) + " " + unit);
  };
  add(evidence.material_path + "youngs_modulus_mpa", evidence.modulus, units.stress, "MPa");
  add(evidence.material_path + "yield_stress_mpa", evidence.yield, units.stress, "MPa");
  add(evidence.material_path + "density_kg_per_m3", evidence.density, units.density, "kg/m^3");
  if (const RegularLattice* lattice = regular_lattice_of(spec)) {
    const std::string path = path_of_lattice(spec);
    add(path + "side_mm", lattice->side_mm.value_or(0.0), units.length, "mm");
    add(path + "wall_thickness_mm", lattice->wall_thickness_mm.value_or(0.0), units.length, "mm");
  }
  if (units.length != 1.0) texts.push_back("all other lengths times " + to_text(units.length));
  const double speed = spec.loading.speed_m_per_s.value_or(0.0);
  if (speed > kFastest * wave_speed(evidence, units)) add("loading.speed_m_per_s", speed, units.speed, "m/s");
  return texts;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    all += (i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ") + texts[i];
  }
  return all;
}

/// The field that makes no sense as given, and why.
Problem symptom_of(const SceneSpec& spec, const Evidence& evidence) {
  const std::string wave = has_sound_wave(evidence, kOfFields)
                               ? ""
                               : " With it an elastic wave would run through the walls at " +
                                     converted(wave_speed(evidence, kOfFields), 3) + " m/s.";
  if (evidence.density < kLightest || evidence.density > kHeaviest) {
    return {evidence.material_path + "density_kg_per_m3", to_text(evidence.density),
            std::string("is ") + (evidence.density < kLightest ? "below" : "above") + " that of any solid." + wave, ""};
  }
  if (!has_sound_material(evidence, kOfFields)) {
    return {evidence.material_path + "youngs_modulus_mpa", to_text(evidence.modulus),
            std::string("is ") + (evidence.modulus < kSoftest ? "typical of rubber." : "above that of diamond.") + wave,
            ""};
  }
  const bool is_listed = regular_lattice_of(spec) == nullptr;
  return {is_listed ? "lattice" : path_of_lattice(spec) + "wall_thickness_mm", to_text(evidence.thickness) + " mm",
          "is thinner than any film.", ""};
}

}  // namespace

std::optional<Problem> find_other_units(const SceneSpec& spec) {
  const std::optional<Evidence> evidence = evidence_of(spec);
  if (!evidence || is_sound(*evidence, kOfFields)) return std::nullopt;
  const UnitSet* units = find_set(*evidence);
  if (units == nullptr) return std::nullopt;
  Problem problem = symptom_of(spec, *evidence);
  problem.message +=
      std::string(" Together the numbers make sense in ") + units->name + ". Is the case in these units?";
  problem.remedy = "Give " + joined(conversions(spec, *evidence, *units)) + ".";
  return problem;
}

void ask_about_units_first(const SceneSpec& spec, Problems& problems) {
  if (problems.empty()) return;
  const std::optional<Problem> units = find_other_units(spec);
  if (!units) return;
  std::erase_if(problems, [&units](const Problem& problem) {
    constexpr std::array kConsequences = {"material", "lattice.frame.beams[0].material", "numerics.time_step_s",
                                          "loading.speed_m_per_s", "loading.end_time_s"};
    const auto concerns = [&problem](const char* path) { return problem.field.starts_with(path); };
    return problem.message == units->message || std::ranges::any_of(kConsequences, concerns);
  });
  problems.insert(problems.begin(), *units);
}

}  // namespace cellcrush
