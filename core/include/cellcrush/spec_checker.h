#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>

#include "cellcrush/run_memory.h"
#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Checks many specs. Problems, words and numbers are those of build_scene, to the last bit. Specs share the measures
/// of one mesh if they differ only in fields on which it does not depend (speed, strains, contact, steps, output). The
/// first spec builds the mesh; each further one costs less than a millisecond, for a specimen that tells its memory.
/// Keeps the measures of the last meshes, not the meshes themselves. Not thread-safe.
class SpecChecker {
 public:
  SpecChecker();
  ~SpecChecker();
  SpecChecker(const SpecChecker&) = delete;
  SpecChecker& operator=(const SpecChecker&) = delete;

  struct Verdict {
    Problems problems;
    Problems notes;                      ///< find_implausible() and find_costly_walls(); none if there are problems
    std::int64_t element_count = 0;      ///< 0 if there are problems
    std::int64_t step_count = 0;         ///< 0 if there are problems
    double reference_steps = 0.0;        ///< time of the run (scene/run_cost.h); 0 if there are problems
    std::int64_t most_memory_bytes = 0;  ///< most_memory_of_run; 0 if there are problems
  };
  /// `before_mesh`: called with the approximate number of elements of the mesh, if one is to be built.
  using BeforeMesh = std::function<void(std::int64_t elements)>;
  Verdict check(const SceneSpec& given, const BeforeMesh& before_mesh = {});

  /// Adds the mesh from which `scene` was built to the known meshes.
  void know(const SceneSpec& given, const Scene& scene);

  /// Approximate number of elements of the mesh that check(given) would build, found without building it. 0 if it would
  /// build none.
  [[nodiscard]] std::int64_t elements_to_build(const SceneSpec& given) const;

 private:
  struct KnownMesh;
  [[nodiscard]] const KnownMesh* find_known(const SceneSpec& part) const;
  const KnownMesh& mesh_of(const SceneSpec& spec, const BeforeMesh& before_mesh);
  void keep(std::unique_ptr<KnownMesh> mesh);

  std::deque<std::unique_ptr<KnownMesh>> known_;  ///< newest first
  MemoryForecast memory_;
};

/// Reports values of a valid spec that are probably mistakes: another unit, walls too thick for beams, a speed near
/// that of an elastic wave in the walls. Worded like a Problem, but none of them prevents the run. REQUIRES: the spec
/// has no problem.
Problems find_implausible(const SceneSpec& spec);

/// Reports the wall of a frame or network that sets the time step if it costs kCostlyWall times as many steps as the
/// others need (scene/slowest_wall.h). Worded as above. REQUIRES: `scene` was built from `spec`.
Problems find_costly_walls(const SceneSpec& spec, const Scene& scene);

}  // namespace cellcrush
