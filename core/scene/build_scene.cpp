#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/fidelity.h"
#include "cellcrush/simulation.h"
#include "contact/contact_faces.h"
#include "contact/wall_paths.h"
#include "measure/theory.h"
#include "scene/check_overlap.h"
#include "scene/check_spec.h"
#include "scene/contact_law.h"
#include "scene/frame.h"
#include "scene/imperfection.h"
#include "scene/lattices.h"
#include "scene/masses.h"
#include "scene/mesh.h"
#include "scene/rigid_bodies.h"
#include "scene/stable_step.h"
#include "scene/time_step.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

constexpr double kTonnePerMm3PerKgPerM3 = 1e-12;
constexpr double kMmPerM = 1e3;

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

void set_plates(const LoadingSpec& spec, double friction, Scene& scene) {
  const int axis = spec.direction == LoadingSpec::Direction::x ? 0 : 1;
  double low = scene.position.front()[axis];
  double high = low;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    low = std::min(low, scene.position[i][axis] - scene.radius[i]);
    high = std::max(high, scene.position[i][axis] + scene.radius[i]);
  }
  const double speed = *spec.speed_m_per_s * kMmPerM;
  const double ramp_time = 2.0 * spec.ramp_strain * scene.length / speed;
  scene.plates = {true, axis, low, high, speed, ramp_time, scene.contact.stiffness, friction};
}

double end_time_of(const SceneSpec& spec, const Scene& scene) {
  if (const auto* frame = std::get_if<FrameLattice>(&spec.lattice)) {
    return *frame->end_time_s;
  }
  return spec.loading.end_strain * scene.length / scene.plates.speed + 0.5 * scene.plates.ramp_time;
}

void set_schedule(const SceneSpec& spec, Scene& scene) {
  const TimeStep step = time_step_of(spec, scene);
  scene.schedule.time_step = step.seconds;
  scene.schedule.bound = step.bound;
  scene.schedule.step_count =
      static_cast<std::int64_t>(std::ceil(end_time_of(spec, scene) / scene.schedule.time_step - 1e-9));
  const auto interval = [&](int count) { return std::max<std::int64_t>(1, scene.schedule.step_count / count); };
  scene.schedule.sample_interval = interval(spec.output.sample_count);
  scene.schedule.frame_interval = interval(spec.output.frame_count);
}

/// REQUIRES: walls that lie in each other have been refused.
void prepare_search(const SceneSpec& spec, Scene& scene) {
  if (!scene.contact.present) {
    return;
  }
  scene.limited_reaches = find_limited_reaches(scene);
  if (spec.contact.search == ContactSpec::Search::faces) {
    scene.faces = build_contact_faces(scene);
  } else {
    scene.faces.premise = ContactFaces::Premise::not_asked;
  }
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

/// Whether any problem keeps the mesh from being built.
bool spoil_mesh(const Problems& problems) {
  return std::any_of(problems.begin(), problems.end(), [](const Problem& problem) {
    const auto starts_with = [&](const char* path) { return problem.field.rfind(path, 0) == 0; };
    return starts_with("lattice") || starts_with("material") || starts_with("depth_mm") ||
           starts_with("elements_per_wall") || starts_with("section");
  });
}

/// Mesh, masses and stable step. REQUIRES: no problem that spoils the mesh.
std::shared_ptr<Scene> build_mesh(const SceneSpec& spec) {
  auto scene = std::make_shared<Scene>();
  set_material_and_mesh(spec, *scene);
  if (const auto* frame = std::get_if<FrameLattice>(&spec.lattice)) {
    attach_to_frame(*frame, *scene);
  }
  scene->mass_scaling = {spec.numerics.mass_scaling, spec.numerics.rotary_scaling};
  lump_masses(*scene);
  lump_rigid_bodies(*scene);
  link_elements(*scene);
  scene->stable_step = stable_step_of(*scene);
  return scene;
}

void check_stability(const SceneSpec& spec, const Scene& scene, Problems& problems) {
  if (spec.numerics.time_step_s > scene.stable_step) {
    problems.push_back(
        {"numerics.time_step_s", to_text(spec.numerics.time_step_s),
         "is above the largest stable step of this mesh, " + to_text(scene.stable_step) + " s.",
         "Give a step of at most " + to_text(kStepFraction * scene.stable_step) + " s, or 0 to have it chosen.",
         Problem::Kind::invalid});
  }
}

/// The field to blame when a run has more steps than any machine does.
void check_step_count(const SceneSpec& spec, const Scene& scene, Problems& problems) {
  constexpr double kMostSteps = 1e10;
  const double fixed = spec.numerics.time_step_s;
  const double count = end_time_of(spec, scene) / time_step_of(spec, scene).seconds;
  if (count <= kMostSteps) {
    return;
  }
  const std::string message = "makes " + to_text(std::round(count)) + " steps, more than 1e10.";
  if (fixed > 0.0) {
    problems.push_back({"numerics.time_step_s", to_text(fixed), message, "Give a longer step, or 0 to have it chosen.",
                        Problem::Kind::invalid});
  } else if (const auto* frame = std::get_if<FrameLattice>(&spec.lattice)) {
    problems.push_back({"lattice.frame.end_time_s", to_text(*frame->end_time_s), message, "Give an earlier end.",
                        Problem::Kind::invalid});
  } else {
    problems.push_back({"loading.speed_m_per_s", to_text(*spec.loading.speed_m_per_s), message, "Give a higher speed.",
                        Problem::Kind::invalid});
  }
}

}  // namespace

SceneResult build_scene(const SceneSpec& given) {
  const SceneSpec spec = fill_in_fidelity(given);
  SceneResult result;
  result.problems = check_spec(spec);
  if (spoil_mesh(result.problems)) {
    return result;
  }
  const std::shared_ptr<Scene> scene = build_mesh(spec);
  check_stability(spec, *scene, result.problems);
  if (!result.problems.empty()) {
    return result;
  }
  scene->mass_damping = spec.numerics.mass_damping_per_s;
  const auto* frame = std::get_if<FrameLattice>(&spec.lattice);
  scene->contact = contact_law_of(spec, frame == nullptr || frame->self_contact, *scene);
  if (scene->contact.present) {
    result.problems = check_overlap(spec, *scene);
  }
  if (frame == nullptr) {
    set_plates(spec.loading, spec.plates.friction, *scene);
  }
  check_step_count(spec, *scene, result.problems);
  if (result.problems.empty()) {
    prepare_search(spec, *scene);
    set_schedule(spec, *scene);
    scene->fidelity = describe_fidelity(given);
    result.scene = scene;
  }
  return result;
}

SceneSpec complete_spec(const SceneSpec& spec, const Scene& scene) {
  SceneSpec complete = fill_in_fidelity(spec);
  if (auto* hexagon = std::get_if<HexagonLattice>(&complete.lattice)) {
    if (!hexagon->vertical_wall_thickness_mm) {
      hexagon->vertical_wall_thickness_mm = hexagon->wall_thickness_mm;
    }
  }
  complete.section.axial_points = spec.section.axial_count();
  complete.section.depth_points = spec.section.depth_count();
  complete.numerics.time_step_s = scene.schedule.time_step;
  return complete;
}

}  // namespace cellcrush
