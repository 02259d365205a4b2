#include "cellcrush/spec_checker.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cellcrush/fidelity.h"
#include "cellcrush/run_memory.h"
#include "lattice/list_walls.h"
#include "scene/check_spec.h"
#include "scene/mesh_part.h"
#include "scene/run_cost.h"
#include "scene/run_plan.h"
#include "scene/slowest_wall.h"

namespace cellcrush {
namespace {

/// Most known meshes: as many as the last axis of a grid over the lattice may have values.
constexpr std::size_t kMostMeshes = 64;

}  // namespace

struct SpecChecker::KnownMesh {
  SceneSpec part;  ///< with the walls as they are given
  MeshMeasures measures;
  Problems problems = {};  ///< of made walls; there is no mesh then
};

SpecChecker::SpecChecker() = default;
SpecChecker::~SpecChecker() = default;

SpecChecker::Verdict SpecChecker::check(const SceneSpec& given, const BeforeMesh& before_mesh) {
  const SceneSpec spec = fill_in_fidelity(given);
  Verdict verdict;
  verdict.problems = check_spec(spec);
  if (prevents_meshing(verdict.problems)) {
    return verdict;
  }
  const KnownMesh& known = mesh_of(spec, before_mesh);
  if (!known.problems.empty()) {
    verdict.problems.insert(verdict.problems.end(), known.problems.begin(), known.problems.end());
    return verdict;
  }
  const MeshMeasures& mesh = known.measures;
  const RunPlan plan = plan_run(spec, mesh, verdict.problems);
  name_made_walls(spec, verdict.problems);
  if (verdict.problems.empty()) {
    verdict.notes = find_implausible(given);
    std::ranges::copy(note_costly_wall(spec, mesh.slowest_wall, plan.schedule.bound),
                      std::back_inserter(verdict.notes));
    verdict.element_count = static_cast<std::int64_t>(mesh.element_count);
    verdict.step_count = plan.schedule.step_count;
    verdict.reference_steps = reference_steps(spec, mesh, plan);
    verdict.most_memory_bytes = memory_.most_of_run(spec, verdict.element_count);
  }
  return verdict;
}

void SpecChecker::know(const SceneSpec& given, const Scene& scene) {
  const SceneSpec part = mesh_part_of(fill_in_fidelity(given));
  keep(std::make_unique<KnownMesh>(KnownMesh{part, measure_sound_mesh(list_walls(part).spec, scene)}));
}

std::int64_t SpecChecker::elements_to_build(const SceneSpec& given) const {
  const SceneSpec spec = fill_in_fidelity(given);
  if (prevents_meshing(check_spec(spec)) || find_known(mesh_part_of(spec)) != nullptr) {
    return 0;
  }
  return static_cast<std::int64_t>(count_elements(spec));
}

const SpecChecker::KnownMesh* SpecChecker::find_known(const SceneSpec& part) const {
  const auto found =
      std::find_if(known_.begin(), known_.end(), [&part](const auto& known) { return known->part == part; });
  return found == known_.end() ? nullptr : found->get();
}

const SpecChecker::KnownMesh& SpecChecker::mesh_of(const SceneSpec& spec, const BeforeMesh& before_mesh) {
  SceneSpec part = mesh_part_of(spec);
  if (const KnownMesh* found = find_known(part)) {
    return *found;
  }
  if (before_mesh) {
    before_mesh(static_cast<std::int64_t>(count_elements(spec)));
  }
  ListedWalls listed = list_walls(part);
  MeshMeasures measures;
  if (listed.problems.empty()) measures = measure_mesh(listed.spec, *build_mesh(listed.spec));
  keep(std::make_unique<KnownMesh>(KnownMesh{std::move(part), measures, std::move(listed.problems)}));
  return *known_.front();
}

void SpecChecker::keep(std::unique_ptr<KnownMesh> mesh) {
  known_.push_front(std::move(mesh));
  if (known_.size() > kMostMeshes) {
    known_.pop_back();
  }
}

}  // namespace cellcrush
