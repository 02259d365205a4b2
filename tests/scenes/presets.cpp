#include "scenes/presets.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "scenes/experiments.h"
#include "scenes/lattices.h"

namespace cellcrush::scenes {
namespace {

/// Perfectly plastic aluminium.
MaterialSpec aluminium(double youngs_modulus_mpa, double yield_stress_mpa) {
  MaterialSpec material;
  material.youngs_modulus_mpa = youngs_modulus_mpa;
  material.yield_stress_mpa = yield_stress_mpa;
  material.density_kg_per_m3 = 2700.0;
  return material;
}

// Example 2 of the paper.
SceneSpec example_2(const char* title, RegularLattice lattice) {
  SceneSpec spec;
  spec.title = title;
  spec.lattice = std::move(lattice);
  spec.depth_mm = 4.0;
  spec.material = aluminium(69000.0, 76.0);
  spec.loading.speed_m_per_s = 100.0;
  return spec;
}

SceneSpec squares_of_example_2(const char* title, int columns, int rows, double side) {
  return example_2(title, squares(columns, rows, side, 0.05132 * side));
}

SceneSpec triangles_of_example_2(const char* title, int columns, int rows, double side) {
  return example_2(title, triangles(columns, rows, side, 0.02963 * side));
}

// Example 1.
SceneSpec papka_kyriakides(const char* number, double side, double thickness) {
  SceneSpec spec;
  spec.title = std::string("Hexagons of Papka and Kyriakides, dimensions ") + number;
  spec.lattice = hexagons(10, 15, side, thickness, 2.0 * thickness);
  spec.depth_mm = 1.0;
  spec.material = aluminium(69000.0, 292.0);
  spec.material.hardening_modulus_mpa = 69000.0 * 690.0 / (69000.0 - 690.0);
  spec.plates.friction = 0.2;
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 1.0;
  spec.numerics.mass_damping_per_s = 100.0;
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  return spec;
}

// Example 3.
SceneSpec inclusions(std::vector<int> rows) {
  SceneSpec spec;
  spec.title = "Hexagons with " + std::to_string(rows.size()) + " lines of stiff inclusions";
  spec.lattice = hexagons(20, 21, 5.0, 0.1, 0.1);
  spec.depth_mm = 5.0;
  spec.elements_per_wall = 10;
  spec.material = aluminium(70000.0, 34.0);
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 1.0;
  spec.loading.end_strain = rows.size() > 2 ? 0.65 : 0.85;
  spec.plates.friction = 0.2;
  spec.inclusions.rows = std::move(rows);
  return spec;
}

// Ruan, Lu, Wang and Yu (2003).
SceneSpec ruan() {
  SceneSpec spec = example_2("Hexagons of Ruan, Lu, Wang and Yu", hexagons(16, 16, 2.7, 0.2));
  spec.depth_mm = 1.0;
  spec.imperfection = {0.027, 1};
  spec.loading.speed_m_per_s = 3.5;
  return spec;
}

// Zheng, Yu and Li (2005).
SceneSpec zheng() {
  SceneSpec spec = example_2("Voronoi honeycomb of Zheng, Yu and Li", {});
  VoronoiWalls honeycomb;
  honeycomb.columns = 20;
  honeycomb.rows = 22;
  honeycomb.side_mm = 2.9;
  honeycomb.irregularity = 0.5;
  honeycomb.seed = 1;
  honeycomb.relative_density = 0.1;
  spec.lattice = honeycomb;
  spec.depth_mm = 1.0;
  return spec;
}

// Ajdari, Nayeb-Hashemi and Vaziri (2011).
SceneSpec ajdari() {
  SceneSpec spec = example_2("Graded hexagons of Ajdari, Nayeb-Hashemi and Vaziri", hexagons(20, 21, 4.0, 0.2));
  spec.changes.grading.thickness_polynomial = {1.5, -1.0};
  return spec;
}

// Gibson, Ashby, Schajer and Robertson (1982).
SceneSpec gibson() {
  SceneSpec spec = example_2("Re-entrant hexagons of Gibson, Ashby, Schajer and Robertson", hexagons(12, 12, 4.0, 0.2));
  cells_of(spec).own = {{"angle_degrees", -30.0}, {"height_mm", 8.0}};
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 2.0;
  return spec;
}

}  // namespace

std::span<const NamedSpec> presets() {
  static const std::vector<NamedSpec> kPresets = {
      {"hexagon-small", example_2("A small specimen of Type I hexagons", hexagons(20, 7, 4.0, 0.3464, 0.3464))},
      {"papka-kyriakides-1", papka_kyriakides("1", 5.51, 0.1448)},
      {"papka-kyriakides-2", papka_kyriakides("2", 5.49, 0.1194)},
      {"type-i", example_2("Type I hexagons", hexagons(74, 21, 4.0, 0.3464, 0.3464))},
      {"type-ii-as-stated", squares_of_example_2("Type II squares, as-stated", 128, 32, 4.0)},
      {"type-ii-as-counted", squares_of_example_2("Type II squares, as-counted", 73, 18, 512.0 / 73.0)},
      {"type-iii-as-stated", triangles_of_example_2("Type III triangles, as-stated", 128, 37, 4.0)},
      {"type-iii-as-counted", triangles_of_example_2("Type III triangles, as-counted", 74, 21, 512.0 / 74.0)},
      {"inclusions-0", inclusions({})},
      {"inclusions-2", inclusions({8, 14})},
      {"inclusions-6", inclusions({3, 6, 9, 13, 16, 19})},
      {"ruan-2003", ruan()},
      {"zheng-2005", zheng()},
      {"ajdari-2011-graded", ajdari()},
      {"gibson-1982-reentrant", gibson()},
      {"struck-block", struck_block()},
      {"thrown-block", thrown_block()},
      {"pressure-pulse", pressure_pulse()},
      {"dropped-weight", dropped_weight()},
      {"loaded-and-unloaded", loaded_and_unloaded()},
      {"brittle-lattice", brittle_lattice()},
      {"tension-test", tension_test()},
      {"voce-hardening", voce_hardening()},
      {"thick-hexagons", thick_hexagons()},
      {"measured-ring", measured_ring()},
  };
  return kPresets;
}

const SceneSpec& preset(std::string_view name) {
  const auto found = std::ranges::find(presets(), name, &NamedSpec::name);
  if (found == presets().end()) throw std::invalid_argument("no preset is called " + std::string(name));
  return found->spec;
}

}  // namespace cellcrush::scenes
