#include <algorithm>

#include "cellcrush/fidelity.h"
#include "cellcrush/lattice_view.h"
#include "cellcrush/lattice_words.h"
#include "cellcrush/simulation.h"
#include "contact/topology/bands.h"
#include "contact/topology/face_loops.h"
#include "contact/topology/initial_overlap.h"
#include "contact/topology/wall_paths.h"
#include "lattice/lattice.h"
#include "lattice/list_walls.h"
#include "push/crush.h"
#include "scene/check_spec.h"
#include "scene/mesh_part.h"
#include "scene/repeat_mesh.h"
#include "scene/run_plan.h"
#include "scene/slowest_wall.h"
#include "scene/solid_area.h"

namespace cellcrush {
namespace {

/// Places the faces of the plates at the surfaces of the walls.
void put_plates(const MeshMeasures& mesh, Scene& scene) {
  scene.length = mesh.length;
  scene.width = mesh.width;
  scene.solid_area = mesh.solid_area;
  const int axis = scene.plates.axis;
  double low = scene.position.front()[axis];
  double high = low;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    low = std::min(low, scene.position[i][axis] - scene.radius[i]);
    high = std::max(high, scene.position[i][axis] + scene.radius[i]);
  }
  scene.plates.impact_face = low;
  scene.plates.support_face = high;
}

/// REQUIRES: walls that cross before loading have been refused; the overlaps of the others are known.
void prepare_search(const SceneSpec& spec, const std::function<void()>& between_stages, Scene& scene) {
  scene.bands = {whole_band(scene)};
  if (scene.period.repeats()) {
    const std::shared_ptr<Scene> repeated = repeat_mesh(scene);
    repeated->limited_reaches = find_limited_reaches(*repeated);
    scene.faces.premise = repeated->faces.premise = ContactFaces::Premise::sides_repeat;
    scene.start_overlaps = original_overlaps(scene, repeated->start_overlaps);
    scene.repeated = repeated;
    return;
  }
  if (!scene.contact.present) {
    return;
  }
  scene.limited_reaches = find_limited_reaches(scene);
  between_stages();
  if (scene.can_break()) {
    scene.faces.premise = ContactFaces::Premise::walls_break;
  } else if (spec.contact.search == ContactSpec::Search::faces) {
    build_contact_faces(scene);
  } else {
    scene.faces.premise = ContactFaces::Premise::not_asked;
  }
}

struct PlannedScene {
  ListedWalls listed;
  std::shared_ptr<Scene> scene;  ///< the mesh alone; null if problems prevent it
  MeshMeasures measures;
  RunPlan plan;
};

/// Overwrites `problems`. REQUIRES: a spec with its fidelity filled in.
PlannedScene plan_scene(const SceneSpec& filled, const std::function<void()>& between_stages, Problems& problems) {
  PlannedScene planned;
  problems = check_spec(filled);
  if (prevents_meshing(problems)) {
    return planned;
  }
  planned.listed = list_walls(filled);
  if (!planned.listed.problems.empty()) {
    problems.insert(problems.end(), planned.listed.problems.begin(), planned.listed.problems.end());
    return planned;
  }
  between_stages();
  const SceneSpec& spec = planned.listed.spec;
  // Built from the mesh part alone, so that specs with the same part have the same mesh.
  const SceneSpec part = mesh_part_of(spec);
  planned.scene = build_mesh(part);
  between_stages();
  planned.measures = measure_mesh(part, *planned.scene);
  planned.plan = plan_run(spec, planned.measures, problems);
  name_made_walls(filled, problems);
  between_stages();
  return planned;
}

}  // namespace

SceneResult build_scene(const SceneSpec& given, const std::function<void()>& between_stages) {
  SceneResult result;
  const auto [listed, scene, measures, plan] = plan_scene(fill_in_fidelity(given), between_stages, result.problems);
  if (!result.problems.empty()) {
    return result;
  }
  const SceneSpec& spec = listed.spec;
  scene->slow_loading = scene->single_fibres && steps_to_yield(spec, measures, plan) > kMostSingleSteps;
  scene->single_fibres = scene->single_fibres && !scene->slow_loading;
  scene->mass_damping = spec.numerics.mass_damping_per_s;
  scene->contact = plan.contact;
  scene->plates = plan.plates;
  if (scene->plates.present) {
    put_plates(measures, *scene);
  } else {
    put_crushing_walls(*scene);
  }
  scene->schedule = plan.schedule;
  if (scene->crushing_walls) scene->schedule.end_strain = spec.loading.end_strain.value_or(0.0);
  scene->start_overlaps = measures.start_overlaps;
  prepare_search(spec, between_stages, *scene);
  between_stages();
  const std::string fidelity = describe_fidelity(given);
  scene->fidelity = listed.words + (listed.words.empty() || fidelity.empty() ? "" : " ") + fidelity;
  result.scene = scene;
  return result;
}

LatticeView view_lattice(const SceneSpec& given, const std::function<void()>& between_stages) {
  LatticeView view;
  const auto [listed, scene, measures, plan] = plan_scene(fill_in_fidelity(given), between_stages, view.problems);
  if (scene == nullptr) {
    return view;
  }
  scene->plates = plan.plates;
  if (scene->plates.present) {
    put_plates(measures, *scene);
  }
  scene->start_overlaps = measures.start_overlaps;
  if (!measures.misplaced.empty()) {
    for (const InitialCrossing& crossing : find_initial_overlaps(*scene, kMostCrossingPlaces).crossings) {
      view.crossings.push_back(crossing.place);
    }
  }
  // Walls of regular lattices are nearly of one length.
  if (regular_lattice_of(listed.spec) == nullptr && measures.slowest_wall.cost > kCostlyWall) {
    view.slowest = measures.slowest_wall.middle;
  }
  view.scene = scene;
  return view;
}

SceneSpec complete_spec(const SceneSpec& spec, const Scene& scene) {
  SceneSpec complete = fill_in_fidelity(spec);
  if (auto* lattice = std::get_if<RegularLattice>(&complete.lattice)) {
    *lattice = with_own_numbers(*lattice);
  }
  complete.section.axial_points = spec.section.axial_count();
  complete.section.depth_points = spec.section.depth_count();
  complete.numerics.time_step_s = scene.schedule.time_step;
  if (!spec.loading.end_strain && scene.plates.present) {
    complete.loading.end_strain =
        scene.schedule.end == RunEnd::closed ? *closing_strain_of(scene) : LoadingSpec::kDefaultEndStrain;
  }
  return complete;
}

}  // namespace cellcrush
