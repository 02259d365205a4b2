#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Checks many specs as build_scene does, with the same problems in the same words, without the scenes. Specs that differ
/// in what their mesh does not depend on (speed, strains, contact, steps, output) share one mesh, so that all but the first of
/// them cost microseconds. Keeps what is known of the last meshes, not the meshes. Not thread-safe.
class SpecChecker {
 public:
  SpecChecker();
  ~SpecChecker();
  SpecChecker(const SpecChecker&) = delete;
  SpecChecker& operator=(const SpecChecker&) = delete;

  struct Verdict {
    Problems problems;
    std::int64_t element_count = 0;  ///< 0 when there are problems
    std::int64_t step_count = 0;     ///< 0 when there are problems
  };
  Verdict check(const SceneSpec& given);

 private:
  struct KnownMesh;
  const KnownMesh& mesh_of(SceneSpec part);

  std::deque<std::unique_ptr<KnownMesh>> known_;  ///< the newest first
};

}  // namespace cellcrush
