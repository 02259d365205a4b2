#include "scenes/crushes.h"

#include "scenes/experiments.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush::scenes {
namespace {

/// Lattices of the other types with the paper's elements, at the step that is chosen for them.
SceneSpec papers(const char* preset) { return with_the_papers_elements(scenes::preset(preset)); }

SceneSpec with_friction() {
  SceneSpec spec = papers_type_i();
  spec.contact.friction = 0.2;
  spec.plates.friction = 0.2;
  return spec;
}

SceneSpec with_hardening() {
  SceneSpec spec = papers_type_i();
  spec.material.hardening_modulus_mpa = 700.0;
  spec.material.isotropic_fraction = 0.5;
  return spec;
}

/// A Voronoi honeycomb of about as many elements as Type I: its faces have from three walls to more than ten, and the
/// nodes of a wall lie anywhere in memory.
SceneSpec uneven_cells() {
  SceneSpec spec = scenes::preset("type-i");
  VoronoiWalls cells;
  cells.columns = 74;
  cells.rows = 22;
  cells.side_mm = 4.0;
  cells.irregularity = 0.5;
  cells.seed = 1;
  cells.wall_thickness_mm = 0.3464;
  spec.lattice = cells;
  return spec;
}

/// Type I whose walls have a law of their own, with the numbers of named materials.
SceneSpec with_law(void (*put)(MaterialSpec& material)) {
  SceneSpec spec = scenes::preset("type-i");
  put(spec.material);
  return spec;
}

void put_table(MaterialSpec& material) {
  material.hardening_table = {{0.0, 0.002, 0.01, 0.05}, {76.0, 90.0, 105.0, 130.0}};
}
void put_voce(MaterialSpec& material) {
  material.voce_stress_mpa = 60.0;
  material.voce_exponent = 40.0;
}
void put_ludwik(MaterialSpec& material) {
  material.ludwik_stress_mpa = 114.0;
  material.ludwik_exponent = 0.42;
}
void put_johnson_cook(MaterialSpec& material) {
  put_ludwik(material);
  material.johnson_cook_coefficient = 0.014;
}
void put_cowper_symonds(MaterialSpec& material) {
  material.cowper_symonds_rate_per_s = 6500.0;
  material.cowper_symonds_exponent = 4.0;
}

/// Walls that could break, but do not: what looking for failure and searching by buckets cost.
void put_failure(MaterialSpec& material) { material.failure_strain = 10.0; }

SceneSpec with_section(bool SectionSpec::*option) {
  SceneSpec spec = scenes::preset("type-i");
  spec.section.*option = true;
  return spec;
}

/// Type I between rigid walls in place of its plates; by a striker of as much mass as it has.
SceneSpec by_rigid_walls(bool strikes) {
  SceneSpec spec = scenes::preset("type-i");
  const double speed = *spec.loading.speed_m_per_s;
  spec.loading.speed_m_per_s.reset();
  spec.loading.end_time_s = 0.8 * 512.7e-3 / speed;
  LoadsSpec::RigidWall striker = striker_at(LoadsSpec::Edge::left, 71.0, speed);
  LoadsSpec::RigidWall plate = wall_at(LoadsSpec::Edge::left);
  plate.functions = {{"velocity_m_per_s", {{0.0, speed}}}};
  spec.loads.rigid_walls = {strikes ? striker : plate, wall_at(LoadsSpec::Edge::right)};
  return spec;
}

/// A part of Type I that has about as many elements, at the step that is chosen for it.
SceneSpec with_elements(int elements, int columns, int rows) {
  SceneSpec spec = papers_type_i();
  auto& lattice = scenes::cells_of(spec);
  lattice.columns = columns;
  lattice.rows = rows;
  spec.elements_per_wall = elements;
  spec.numerics.time_step_s = 0.0;
  return spec;
}

}  // namespace

SceneSpec with_the_papers_elements(SceneSpec spec) {
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  spec.section.area_rule = SectionSpec::AreaRule::constant_area;
  return spec;
}

SceneSpec papers_type_i() {
  SceneSpec spec = papers("type-i");
  spec.numerics.time_step_s = 2e-7;
  return spec;
}

SceneSpec papers_type_i_wider(int times) {
  SceneSpec spec = papers_type_i();
  auto& lattice = scenes::cells_of(spec);
  lattice.rows = times * *lattice.rows;
  return spec;
}

std::vector<Crush> crushes() {
  return {{"type-i-paper", papers_type_i(), {0.20, 0.45, 0.80}},
          {"type-i-default", scenes::preset("type-i"), {0.20, 0.45, 0.80}},
          {"squares", papers("type-ii-as-counted"), {0.20}},
          {"triangles", papers("type-iii-as-counted"), {0.20}},
          {"voronoi", uneven_cells(), {0.20, 0.45}},
          {"friction", with_friction(), {0.45}},
          {"hardening", with_hardening(), {0.45}},
          {"hardening-table", with_law(put_table), {0.20}},
          {"voce", with_law(put_voce), {0.20}},
          {"ludwik", with_law(put_ludwik), {0.20}},
          {"johnson-cook", with_law(put_johnson_cook), {0.20}},
          {"cowper-symonds", with_law(put_cowper_symonds), {0.20}},
          {"breakable", with_law(put_failure), {0.20}},
          {"shear", with_section(&SectionSpec::shear_deformation), {0.20}},
          {"rigid-joints", with_section(&SectionSpec::rigid_joints), {0.20}},
          {"rigid-walls", by_rigid_walls(false), {0.20}},
          {"striker", by_rigid_walls(true), {0.20}},
          {"four-elements", with_elements(4, 52, 15), {0.20}},
          {"ten-elements", with_elements(10, 33, 9), {0.20}}};
}

SceneSpec spec_of(const SmallSpecimen& specimen, int columns, int rows) {
  constexpr double kSide = 4.0;  // mm
  constexpr int kElementsAlongCrush = 8;
  SceneSpec spec = hexagon_specimen(columns, rows);
  const std::string lattice = specimen.lattice;
  if (lattice == "square") {
    spec.lattice = scenes::squares(columns, rows, kSide, 0.05132 * kSide);
    spec.elements_per_wall = kElementsAlongCrush;
  } else if (lattice == "triangle") {
    spec.lattice = scenes::triangles(columns, rows, kSide, 0.02963 * kSide);
    spec.elements_per_wall = kElementsAlongCrush;
  } else if (lattice == "thick") {
    spec.lattice = scenes::hexagons(columns, rows, kSide, 0.25, 0.5);
  } else if (lattice == "thick_ends") {
    spec.lattice = scenes::hexagons(columns, rows, kSide, 0.5, 0.9);
    spec.loading.direction = LoadingSpec::Direction::y;
    spec.elements_per_wall = 2;
  }
  if (specimen.elements > 0) {
    spec.elements_per_wall = specimen.elements;
  }
  spec.loading.speed_m_per_s = specimen.speed;
  spec.contact.friction = spec.plates.friction = specimen.friction;
  spec.imperfection = {0.01, 1};
  return spec;
}

std::string name_of(const ::testing::TestParamInfo<SmallSpecimen>& test) {
  return std::string(test.param.lattice) + "At" + std::to_string(static_cast<int>(test.param.speed)) +
         (test.param.friction > 0.0 ? "WithFriction" : "") +
         (test.param.elements > 0 ? "Of" + std::to_string(test.param.elements) + "Elements" : "");
}

}  // namespace cellcrush::scenes
