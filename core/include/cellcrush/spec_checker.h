#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

class LatticeMeasurer;

/// Checks many specs as build_scene does, with the same problems in the same words and the same numbers to the last bit, without
/// the scenes. Specs that differ in what their mesh does not depend on (speed, strains, contact, steps, output) share what is
/// known of it, and of most regular lattices it is known without their mesh, so that thickness, size, material or seed cost
/// microseconds. Meshes of frames are built, and those of lattices whose walls may lie in each other. Keeps what is known of
/// the last meshes, not the meshes. Not thread-safe.
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
    /// As SceneFacts has it, or more by the faces of a mesh that is searched by buckets after all; 0 when there are problems.
    std::int64_t most_memory_bytes = 0;
  };
  Verdict check(const SceneSpec& given);

  /// Meshes that had to be built.
  [[nodiscard]] std::int64_t built_count() const { return built_count_; }

 private:
  struct KnownMesh;
  const KnownMesh& mesh_of(SceneSpec part);

  std::unique_ptr<LatticeMeasurer> lattices_;
  std::int64_t built_count_ = 0;
  std::deque<std::unique_ptr<KnownMesh>> known_;  ///< the newest first
};

}  // namespace cellcrush
