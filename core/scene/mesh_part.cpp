#include "scene/mesh_part.h"

#include <algorithm>
#include <iterator>

#include "cellcrush/lattice_moduli.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"
#include "lattice/network.h"
#include "lattice/period.h"
#include "law/flow_curve.h"
#include "push/half_planes.h"
#include "scene/approach_speed.h"
#include "scene/check_spec.h"
#include "scene/frame.h"
#include "scene/grips.h"
#include "scene/mesh.h"
#include "scene/rigid_joints.h"
#include "scene/rigid_links.h"
#include "scene/solid_area.h"
#include "scene/time_step.h"
#include "scene/unit_walls.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

constexpr double kTonnePerMm3PerKgPerM3 = 1e-12;

/// Index of the law of a scene of some materials.
std::size_t law_of(const std::vector<Material>& materials) {
  const auto describes_all = [&](const LawFacts& law) {
    return std::ranges::all_of(materials, law.describes, &Material::law);
  };
  return static_cast<std::size_t>(std::ranges::find_if(Laws::kFacts, describes_all) - Laws::kFacts.begin());
}

bool allows_single_fibres(const Scene& scene) {
  return !can_break(scene.materials) && has_known_counts(scene.section) &&
         (scene.section.force_based ? Laws::kFacts[scene.law].may_be_single_in_force_based
                                    : Laws::kFacts[scene.law].may_be_single);
}

/// Lays out the lattice, and computes the measures that a frame has not. The last walls of a list may be rigid links.
Layout lay_out(const SceneSpec& spec, int links, Scene& scene) {
  if (const auto* frame = std::get_if<FrameWalls>(&spec.lattice)) {
    Layout layout = lay_out_frame(*frame, *spec.elements_per_wall, links);
    layout.envelope = bounds_of(layout.joints);
    return layout;
  }
  const auto* network = std::get_if<NetworkWalls>(&spec.lattice);
  const LatticeKind* kind = kind_of(spec);
  Layout layout = network != nullptr ? lay_out_network(*network, links) : kind->lay_out(spec);
  const int axis = crush_axis_of(spec);
  const double period = period_of(spec);
  if (period > 0.0) close_period(1 - axis, period, layout);
  divide_walls(*spec.elements_per_wall, layout);
  const Vector2 envelope = envelope_of(layout.joints);
  scene.length = envelope[axis];
  scene.width = period > 0.0 ? period : envelope[1 - axis];
  if (kind != nullptr) {
    const ClosedForms forms = kind->closed_forms(*regular_lattice_of(spec), spec.loading.direction);
    scene.collapse_stress = forms.collapse_stress.value_or(0.0) * *spec.material.yield_stress_mpa;
  }
  const std::vector<Vector2> places = layout.joints;
  layout.envelope = bounds_of(places);
  perturb(spec.imperfection, layout);
  bow(spec.imperfection, layout.walls);
  if (period > 0.0) align_images(1 - axis, period, layout);
  number_columns(places, axis, layout);
  return layout;
}

/// The sides that repeat. Images have no balls of their own: what would press on one presses on its joint.
void attach_period(const SceneSpec& part, const Layout& layout, Scene& scene) {
  if (layout.images.empty()) return;
  scene.period.axis = 1 - crush_axis_of(part);
  scene.period.length = period_of(part);
  scene.period.is_fixed = part.loading.sides.fixed_width;
  for (const auto& [low, high] : layout.images) {
    scene.period.low.push_back(low);
    scene.period.high.push_back(high);
    scene.radius[low] = std::max(scene.radius[low], scene.radius[high]);
    scene.radius[high] = 0.0;
  }
  scene.smallest_radius = 0.0;
}

/// Of the envelope along x and y, mm; 0 of a frame.
Vector2 lattice_extent_of(const SceneSpec& part, const Scene& scene) {
  return crush_axis_of(part) == 0 ? Vector2(scene.length, scene.width) : Vector2(scene.width, scene.length);
}

/// Adds the velocity of all walls to those of nodes, in what is not held.
void throw_lattice(const LoadsSpec& loads, Scene& scene) {
  const Vector2 velocity = Vector2(loads.velocity_x_m_per_s, loads.velocity_y_m_per_s) * kMmPerM;
  if (velocity.isZero(0.0)) return;
  scene.initial_velocity.resize(scene.particle_count(), Vector2::Zero());
  scene.initial_spin.resize(scene.particle_count(), 0.0);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const Support held = scene.supports.empty() ? Support() : scene.supports[i];
    scene.initial_velocity[i] += Vector2(held.x.held ? 0.0 : velocity.x(), held.y.held ? 0.0 : velocity.y());
  }
}

/// Of a particle, or of a joint and its image together, tonne.
double lightest_mass_of(const Scene& scene) {
  std::vector<double> mass = scene.mass;
  for (std::size_t p = 0; p < scene.period.low.size(); ++p) {
    const int low = scene.period.low[p];
    const int high = scene.period.high[p];
    mass[low] = mass[high] = scene.mass[low] + scene.mass[high];
  }
  return std::ranges::min(mass);
}

}  // namespace

Material material_of(const MaterialSpec& spec) {
  using Plane = MaterialSpec::Plane;
  const bool held = spec.plane != Plane::stress;
  const double elastic = spec.plane == Plane::strain ? 1.0 / (1.0 - spec.poissons_ratio * spec.poissons_ratio) : 1.0;
  const double flowing = held ? kHeldFlow : 1.0;
  Material material = {elastic * *spec.youngs_modulus_mpa,
                       flowing * *spec.yield_stress_mpa,
                       spec,
                       *spec.density_kg_per_m3 * kTonnePerMm3PerKgPerM3,
                       held,
                       spec.plane == Plane::strip,
                       {},
                       {}};
  if (held) {
    hold_walls(material.law);
  }
  material.hardening = bent_line_of(material.law.hardening_table);
  material.rate = bent_line_of_rate(material.law);
  return material;
}

std::vector<MaterialSpec> material_specs_of(const SceneSpec& spec) {
  std::vector<MaterialSpec> specs = {spec.material};
  if (const auto* frame = std::get_if<FrameWalls>(&spec.lattice)) {
    for (const FrameWalls::Beam& beam : frame->beams) {
      if (beam.material) specs.push_back(*beam.material);
    }
  }
  if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    specs.insert(specs.end(), network->materials.begin(), network->materials.end());
  }
  return specs;
}

std::optional<LatticeModuli> elastic_moduli_of(const SceneSpec& spec) {
  const LatticeKind* kind = kind_of(spec);
  if (kind == nullptr || spec.changes != LatticeChanges() || spec.section.shear_deformation ||
      spec.section.rigid_joints) {
    return std::nullopt;
  }
  const double modulus_of_walls = material_of(spec.material).youngs_modulus;
  const auto moduli_in = [&](LoadingSpec::Direction direction) {
    const ClosedForms forms = kind->closed_forms(*regular_lattice_of(spec), direction);
    return ElasticModuli{forms.modulus * modulus_of_walls, forms.poissons_ratio};
  };
  using Direction = LoadingSpec::Direction;
  const bool is_along_x = crush_axis_of(spec) == 0;
  return LatticeModuli{moduli_in(spec.loading.direction), moduli_in(is_along_x ? Direction::y : Direction::x)};
}

int crush_axis_of(const SceneSpec& spec) { return spec.loading.direction == LoadingSpec::Direction::x ? 0 : 1; }

bool has_plates(const SceneSpec& spec) { return spec.loading.speed_m_per_s.has_value() || spec.loading.quasi_static; }

bool is_driven_by_plates_alone(const SceneSpec& spec) { return has_plates(spec) && spec.loads == LoadsSpec(); }

SceneSpec mesh_part_of(const SceneSpec& spec) {
  SceneSpec part = spec;
  part.title.clear();
  part.contact = {};
  part.plates = {};
  part.loading = {};
  part.loading.direction = spec.loading.direction;
  part.loading.sides = spec.loading.sides;
  part.numerics = {};
  part.numerics.mass_scaling = spec.numerics.mass_scaling;
  part.numerics.rotary_scaling = spec.numerics.rotary_scaling;
  part.numerics.rigid_link_slenderness = spec.numerics.rigid_link_slenderness;
  part.numerics.fibre_precision = spec.numerics.fibre_precision;
  part.output = {};
  return part;
}

std::shared_ptr<Scene> build_mesh(const SceneSpec& given) {
  const LinkedSpec linked = put_rigid_links_first(given);
  const SceneSpec& part = linked.spec;
  auto scene = std::make_shared<Scene>();
  scene->depth = *part.depth_mm;
  std::ranges::transform(material_specs_of(part), std::back_inserter(scene->materials), material_of);
  scene->law = law_of(scene->materials);
  scene->section = make_section_rule(part.section);
  scene->constant_area = part.section.area_rule == SectionSpec::AreaRule::constant_area;
  scene->single_fibres =
      part.numerics.fibre_precision == NumericsSpec::FibrePrecision::single_precision && allows_single_fibres(*scene);
  Layout layout = lay_out(part, linked.links, *scene);
  if (part.section.rigid_joints) {
    scene->listed_walls = layout.walls.size();
    add_rigid_joints(layout);
    scene->rigid.are_joints = true;
  }
  if (can_break(scene->materials)) divide_into_units(scene->section.force_based, layout);
  scene->rigid.offset = put_rigid_bodies_first(layout);
  // The beams of a frame have loads and pins by their numbers.
  if (!std::holds_alternative<FrameWalls>(part.lattice)) fill_blocks(layout);
  scene->list_order = layout.order.after(linked.order);
  scene->rigid.links = static_cast<std::size_t>(linked.links);
  divide_walls(layout, *scene);
  if (can_break(scene->materials)) number_chains(*scene);
  let_walls_shear(material_specs_of(part), *scene);
  if (const auto* frame = std::get_if<FrameWalls>(&part.lattice)) {
    attach_to_frame(*frame, layout.order, part.loads, *scene);
  }
  scene->gravity = Vector2(part.loads.gravity_x_m_per_s2, part.loads.gravity_y_m_per_s2) * kMmPerM;
  attach_grips(part, layout.envelope, *scene);
  scene->mass_scaling = {part.numerics.mass_scaling, part.numerics.rotary_scaling};
  lump_masses(*scene);
  attach_period(part, layout, *scene);
  attach_half_planes(part.loads, lattice_extent_of(part, *scene), *scene);
  attach_side_walls(part.loading, *scene);
  throw_lattice(part.loads, *scene);
  lump_rigid_bodies(*scene);
  link_elements(*scene);
  scene->solid_area = solid_area_of(*scene);
  scene->stable_step = steps_of(*scene).stable;
  return scene;
}

namespace {

/// Of the joints along an axis.
double extent_of(const Scene& scene, int axis) {
  const auto [low, high] =
      std::ranges::minmax(scene.position, {}, [axis](const Vector2& place) { return place[axis]; });
  return high[axis] - low[axis];
}

/// Rigid links, which move as bodies of their own.
Problems find_rigid_in_period(const Scene& scene) {
  if (!scene.period.repeats() || scene.rigid.count() == 0) return {};
  return {{"numerics.rigid_link_slenderness", "",
           "makes rigid links of " + std::to_string(scene.rigid_element_count()) +
               " short walls, which do not go with periodic sides.",
           "Set it to 0, or join the ends of short walls."}};
}

}  // namespace

MeshMeasures measure_sound_mesh(const SceneSpec& part, const Scene& scene) {
  MeshMeasures measures;
  measures.element_count = scene.element_count();
  // A regular lattice has those of its layout, before any imperfection.
  const int axis = crush_axis_of(part);
  measures.length = scene.length > 0.0 ? scene.length : extent_of(scene, axis);
  // A straight column is as wide as it is thick.
  measures.width = std::max(scene.length > 0.0 ? scene.width : extent_of(scene, 1 - axis), 2.0 * scene.largest_radius);
  const double envelope = measures.length * measures.width;
  const bool can_close = regular_lattice_of(part) != nullptr || scene.solid_area < kClosed * envelope;
  measures.solid_area = can_close ? scene.solid_area : 0.0;
  measures.closing_strain = closing_strain_of(scene.solid_area, envelope);
  const double solid_mass = scene.materials.front().density * envelope * scene.depth;
  measures.relative_density = solid_mass > 0.0 ? scene.total_mass / solid_mass : 0.0;
  measures.steps = steps_of(scene);
  measures.slowest_wall = slowest_wall_of(scene);
  measures.lightest_mass = lightest_mass_of(scene);
  measures.shortest_element = std::ranges::min(scene.walls.undeformed_length);
  measures.thinnest_wall = std::ranges::min(scene.elements, {}, &Element::thickness).thickness;
  measures.approach_speed = approach_speed_of(scene);
  measures.material = scene.materials.front();
  measures.walls_along_crush = has_walls_along_crush(part);
  if (const RegularLattice* lattice = regular_lattice_of(part)) {
    measures.bending_share = std::min(1.0, 3.0 * measures.thinnest_wall / *lattice->side_mm);
  }
  const auto* frame = std::get_if<FrameWalls>(&part.lattice);
  measures.rigid_walls = !scene.rigid_walls.empty();
  for (const RigidWall& wall : scene.rigid_walls) {
    if (wall.mass > 0.0) {
      const double pressed = static_cast<double>(scene.particle_count()) * measures.lightest_mass;
      measures.pressed_share = std::max(measures.pressed_share, pressed / wall.mass);
    }
  }
  measures.contact = frame == nullptr || frame->self_contact;
  return measures;
}

MeshMeasures measure_mesh(const SceneSpec& part, const Scene& scene) {
  MeshMeasures measures = measure_sound_mesh(part, scene);
  if (measures.contact && (!scene.period.repeats() || scene.rigid.count() == 0)) {
    measures.misplaced = check_crossings(part, scene, measures.start_overlaps);
  }
  const auto* frame = std::get_if<FrameWalls>(&part.lattice);
  const Problems sunk = find_walls_in_half_planes(scene, frame == nullptr ? 0 : frame->nodes.size());
  const Problems loose = find_grip_problems(scene);
  const Problems rigid = find_rigid_in_period(scene);
  for (const Problems* more : {&sunk, &loose, &rigid}) {
    measures.misplaced.insert(measures.misplaced.end(), more->begin(), more->end());
  }
  return measures;
}

}  // namespace cellcrush
