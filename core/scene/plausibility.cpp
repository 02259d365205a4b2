#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "cellcrush/spec_checker.h"
#include "lattice/lattice.h"
#include "scene/check_spec.h"
#include "scene/mesh_part.h"
#include "scene/quasi_static.h"
#include "scene/unit_sets.h"

namespace cellcrush {
namespace {

constexpr double kSheared = 0.2;    // of the side
constexpr double kThickest = 0.25;  // of the side
constexpr double kThinnest = 5e-4;  // of the side

std::string percent(double share) { return to_text(std::round(1000.0 * share) / 10.0) + " %"; }

void check_density(double density, FieldChecker& notes) {
  const std::string field = "material.density_kg_per_m3";
  if (density < 1e-3) {
    notes.add(field, to_text(density), "is far below that of any solid. Is it in tonne/mm^3?",
              "Give it in kg/m^3: aluminium has 2700.");
  } else if (density < 30.0) {
    notes.add(field, to_text(density), "is far below that of any solid. Is it in g/cm^3?",
              "Give it in kg/m^3: " + to_text(density) + " g/cm^3 is " + to_text(1000.0 * density) + " kg/m^3.");
  } else if (density < kLightest || density > kHeaviest) {
    notes.add(field, to_text(density),
              density < kLightest ? "is below that of any solid." : "is above that of any metal.",
              "Give the density of the wall material, not of the lattice; aluminium has 2700 kg/m^3.");
  }
}

void check_stiffness(const MaterialSpec& material, FieldChecker& notes) {
  const double modulus = *material.youngs_modulus_mpa;
  const std::string field = "material.youngs_modulus_mpa";
  if (modulus < kSoftest) {
    notes.add(field, to_text(modulus), "is typical of rubber. Is it in GPa?",
              "Give it in MPa: " + to_text(modulus) + " GPa is " + to_text(1000.0 * modulus) + " MPa.");
  } else if (modulus > kStiffest) {
    notes.add(field, to_text(modulus), "is above that of diamond. Is it in Pa or kPa?",
              "Give it in MPa: aluminium has 69000.");
  }
  const double yield_strain = *material.yield_stress_mpa / modulus;
  const std::string ratio = "is " + percent(yield_strain) + " of youngs_modulus_mpa";
  if (yield_strain > kGreatestYield) {
    notes.add("material.yield_stress_mpa", to_text(*material.yield_stress_mpa),
              ratio + "; metals yield at 0.05 to 1 %, polymers at up to 5 %.", "Check the units of both.");
  } else if (yield_strain < kLeastYield) {
    notes.add("material.yield_stress_mpa", to_text(*material.yield_stress_mpa),
              "is " + to_text(yield_strain) + " of youngs_modulus_mpa; annealed metals yield at 0.0002 or more.",
              "Check the units of both.");
  }
}

/// A field that says how thick walls are over their length.
struct Thickness {
  std::string field;
  std::string value;
  double slenderness;
  std::string words;
};

std::string of_side(double slenderness) {
  return "is " + (slenderness < kThinnest ? to_text(slenderness) : percent(slenderness)) + " of side_mm";
}

/// Of a frame none: its walls are listed in pieces.
std::optional<Thickness> thickness_of(const SceneSpec& spec) {
  if (const RegularLattice* lattice = regular_lattice_of(spec)) {
    const double slenderness = *lattice->wall_thickness_mm / *lattice->side_mm;
    return Thickness{path_of_lattice(spec) + "wall_thickness_mm", to_text(*lattice->wall_thickness_mm), slenderness,
                     of_side(slenderness)};
  }
  if (const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice)) {
    const std::string path = "lattice.voronoi.";
    if (voronoi->wall_thickness_mm) {
      const double slenderness = *voronoi->wall_thickness_mm / *voronoi->side_mm;
      return Thickness{path + "wall_thickness_mm", to_text(*voronoi->wall_thickness_mm), slenderness,
                       of_side(slenderness)};
    }
    const double slenderness = 0.5 * std::numbers::sqrt3 * *voronoi->relative_density;  // of the regular hexagons
    return Thickness{path + "relative_density", to_text(*voronoi->relative_density), slenderness,
                     "makes walls as thick as about " + percent(slenderness) + " of side_mm"};
  }
  if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    double length = 0.0;
    double thickness = 0.0;
    for (std::size_t w = 0; w < network->wall_count(); ++w) {
      const double* const start = &network->joints_mm[2 * network->walls[2 * w]];
      const double* const end = &network->joints_mm[2 * network->walls[2 * w + 1]];
      length += std::hypot(end[0] - start[0], end[1] - start[1]);
      thickness += network->thicknesses_mm.empty() ? *network->wall_thickness_mm : network->thicknesses_mm[w];
    }
    const std::string mean = to_text(thickness / static_cast<double>(network->wall_count()));
    return Thickness{"lattice.network.walls", mean, thickness / length,
                     "mm is the mean thickness, " + percent(thickness / length) + " of the mean length"};
  }
  return std::nullopt;
}

/// Walls that bend are too stiff by 2 (1 + nu) / kappa times the square of h/l without shear (E5i).
void check_shear(const SceneSpec& spec, const Thickness& walls, FieldChecker& notes) {
  const double error =
      2.0 * (1.0 + spec.material.poissons_ratio) / spec.section.shear_factor * walls.slenderness * walls.slenderness;
  notes.add(walls.field, walls.value,
            walls.words + ": walls are modelled without shear, so those that bend are about " +
                to_text(std::round(100.0 * error)) + " % too stiff before they yield.",
            "Set section.shear_deformation to true, with force-based elements.");
}

void check_walls(const SceneSpec& spec, const Thickness& walls, FieldChecker& notes) {
  if (walls.slenderness > kSheared && !spec.section.shear_deformation) check_shear(spec, walls, notes);
  if (walls.slenderness > kThickest) {
    notes.add(walls.field, walls.value,
              walls.words + (spec.section.rigid_joints
                                 ? ": joints are a large part of walls so thick, and rigid in the model."
                                 : ": joints are a large part of walls so thick, and have no size in the model."),
              spec.section.rigid_joints ? "Use the result as an upper bound."
                                        : "Compare with section.rigid_joints, which is an upper bound.");
  } else if (walls.slenderness < kThinnest) {
    notes.add(walls.field, walls.value, walls.words + ", thinner than any honeycomb.", "Check the units of both.");
  }
}

/// A speed at which nothing moves but at the pace of the plate: that of a testing machine, typed as it is.
void check_slowness(const SceneSpec& spec, FieldChecker& notes) {
  constexpr double kThinnestLattice = 0.01;  // relative density: at a higher one the fast enough speed is higher
  constexpr double kTooSlow = 20.0;
  const double share = LoadingSpec().kinetic_share;
  const double enough = quasi_static_speed(share, kThinnestLattice, material_of(spec.material)) / kMmPerM;
  const double speed = *spec.loading.speed_m_per_s;
  if (kTooSlow * speed < enough && !spec.material.depends_on_rate()) {
    notes.add("loading.speed_m_per_s", to_text(speed),
              "is far slower than inertia asks for: the number of steps grows as the speed falls, and already at " +
                  to_text(std::round(10.0 * enough) / 10.0) + " m/s, in " + to_text(std::round(enough / speed)) +
                  " times fewer steps, the kinetic energy is under 1 % of the work.",
              "Give loading.quasi_static instead of a speed. Walls do not depend on the strain rate.");
  }
}

void check_speed(const SceneSpec& spec, FieldChecker& notes) {
  constexpr double kPascal = 1e6;  // in a MPa
  const double wave = std::sqrt(*spec.material.youngs_modulus_mpa * kPascal / *spec.material.density_kg_per_m3);
  const double share = *spec.loading.speed_m_per_s / wave;
  if (share > kFastest) {
    notes.add("loading.speed_m_per_s", to_text(*spec.loading.speed_m_per_s),
              "is " + percent(share) + " of the speed of an elastic wave in the walls, " + to_text(std::round(wave)) +
                  " m/s. At such speeds " + (spec.material.depends_on_rate() ? "" : "strain-rate and ") +
                  "thermal effects matter, which are not modelled.",
              "Check the speed, and the units of youngs_modulus_mpa and density_kg_per_m3.");
  }
}

}  // namespace

Problems find_implausible(const SceneSpec& spec) {
  FieldChecker notes;
  if (const std::optional<Thickness> walls = thickness_of(spec)) check_walls(spec, *walls, notes);
  if (const auto units = find_other_units(spec)) {
    notes.add(units->field, units->value, units->message, units->remedy);
    return notes.take();  // all else follows from them
  }
  const MaterialSpec& material = spec.material;
  if (!material.youngs_modulus_mpa || !material.yield_stress_mpa || !material.density_kg_per_m3) {
    return notes.take();  // a frame whose beams have their own materials
  }
  check_stiffness(material, notes);
  check_density(*material.density_kg_per_m3, notes);
  if (!spec.loading.speed_m_per_s) return notes.take();
  check_speed(spec, notes);
  Problems found = notes.take();
  if (!found.empty()) return found;  // what is slow follows from sound units
  check_slowness(spec, notes);
  return notes.take();
}

}  // namespace cellcrush
