#include "scene/mesh_part.h"

#include <algorithm>
#include <numbers>

#include "measure/theory.h"
#include "scene/check_overlap.h"
#include "scene/frame.h"
#include "scene/imperfection.h"
#include "scene/lattices.h"
#include "scene/masses.h"
#include "scene/mesh.h"
#include "scene/rigid_bodies.h"
#include "scene/stable_step.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

constexpr double kTonnePerMm3PerKgPerM3 = 1e-12;

/// What a fibre along the wall shows. In plane strain it is held across: elastically E / (1 - nu^2); flowing, the stress
/// along it is 2 / sqrt 3 of the effective stress and its strain sqrt 3 / 2 of the effective one.
Material material_of(const MaterialSpec& spec) {
  const bool held = spec.plane == MaterialSpec::Plane::strain;
  const double elastic = held ? 1.0 / (1.0 - spec.poissons_ratio * spec.poissons_ratio) : 1.0;
  const double flowing = held ? 2.0 / std::numbers::sqrt3 : 1.0;
  return {elastic * *spec.youngs_modulus_mpa, flowing * *spec.yield_stress_mpa,
          flowing * flowing * spec.hardening_modulus_mpa, spec.isotropic_fraction,
          *spec.density_kg_per_m3 * kTonnePerMm3PerKgPerM3};
}

std::vector<Material> materials_of(const SceneSpec& spec) {
  std::vector<Material> materials = {material_of(spec.material)};
  if (const auto* frame = std::get_if<FrameLattice>(&spec.lattice)) {
    for (const FrameLattice::Beam& beam : frame->beams) {
      if (beam.material) {
        materials.push_back(material_of(*beam.material));
      }
    }
  }
  return materials;
}

/// Lays out a regular lattice and takes its measures.
template <class Lattice>
Layout measure(const SceneSpec& spec, const Lattice& lattice, Layout layout, Scene& scene) {
  const Vector2 envelope = envelope_of(lattice);
  const bool along_x = spec.loading.direction == LoadingSpec::Direction::x;
  scene.length = along_x ? envelope.x() : envelope.y();
  scene.width = along_x ? envelope.y() : envelope.x();
  scene.collapse_stress = collapse_stress_of(lattice, *spec.material.yield_stress_mpa, spec.loading.direction);
  perturb(spec.imperfection, layout);
  return layout;
}

Layout lay_out(const SceneSpec& spec, Scene& scene) {
  const int elements = *spec.elements_per_wall;
  if (const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    return measure(spec, *hexagon, lay_out(*hexagon, spec.inclusions, elements), scene);
  }
  if (const auto* square = std::get_if<SquareLattice>(&spec.lattice)) {
    return measure(spec, *square, lay_out(*square, elements), scene);
  }
  if (const auto* triangle = std::get_if<TriangleLattice>(&spec.lattice)) {
    return measure(spec, *triangle, lay_out(*triangle, elements), scene);
  }
  return lay_out_frame(std::get<FrameLattice>(spec.lattice), elements);
}

void set_material_and_mesh(const SceneSpec& spec, Scene& scene) {
  scene.depth = *spec.depth_mm;
  scene.materials = materials_of(spec);
  scene.section = make_section_rule(spec.section);
  Layout layout = lay_out(spec, scene);
  scene.rigid.offset = put_rigid_bodies_first(layout);
  divide_walls(layout, scene);
  scene.constant_area = spec.section.area_rule == SectionSpec::AreaRule::constant_area;
  scene.single_fibres = spec.numerics.fibre_precision == NumericsSpec::FibrePrecision::single_precision &&
                        scene.fibre_count() <= kMostSingleFibres;
}

}  // namespace

SceneSpec mesh_part_of(const SceneSpec& spec) {
  SceneSpec part = spec;
  part.title.clear();
  part.contact = {};
  part.plates = {};
  part.loading = {};
  part.loading.direction = spec.loading.direction;
  part.numerics = {};
  part.numerics.mass_scaling = spec.numerics.mass_scaling;
  part.numerics.rotary_scaling = spec.numerics.rotary_scaling;
  part.numerics.fibre_precision = spec.numerics.fibre_precision;
  part.output = {};
  if (auto* frame = std::get_if<FrameLattice>(&part.lattice)) {
    frame->end_time_s.reset();
  }
  return part;
}

std::shared_ptr<Scene> build_mesh(const SceneSpec& part) {
  auto scene = std::make_shared<Scene>();
  set_material_and_mesh(part, *scene);
  if (const auto* frame = std::get_if<FrameLattice>(&part.lattice)) {
    attach_to_frame(*frame, *scene);
  }
  scene->mass_scaling = {part.numerics.mass_scaling, part.numerics.rotary_scaling};
  lump_masses(*scene);
  lump_rigid_bodies(*scene);
  link_elements(*scene);
  scene->stable_step = stable_step_of(*scene);
  return scene;
}

MeshMeasures measure_mesh(const SceneSpec& part, const Scene& scene) {
  MeshMeasures measures;
  measures.element_count = scene.element_count();
  measures.length = scene.length;
  const int axis = part.loading.direction == LoadingSpec::Direction::x ? 0 : 1;
  measures.low = scene.position.front()[axis];
  measures.high = measures.low;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    measures.low = std::min(measures.low, scene.position[i][axis] - scene.radius[i]);
    measures.high = std::max(measures.high, scene.position[i][axis] + scene.radius[i]);
  }
  measures.stable_step = scene.stable_step;
  measures.lightest_mass = *std::min_element(scene.mass.begin(), scene.mass.end());
  measures.shortest_element =
      *std::min_element(scene.walls.undeformed_length.begin(), scene.walls.undeformed_length.end());
  measures.thinnest_wall = scene.elements.front().thickness;
  for (const Element& element : scene.elements) {
    measures.thinnest_wall = std::min(measures.thinnest_wall, element.thickness);
  }
  measures.material = scene.materials.front();
  const auto* frame = std::get_if<FrameLattice>(&part.lattice);
  measures.contact = frame == nullptr || frame->self_contact;
  if (measures.contact) {
    measures.overlaps = check_overlap(part, scene);
  }
  return measures;
}

}  // namespace cellcrush
