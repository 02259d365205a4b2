#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "cellcrush/problem.h"
#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Checks many specs as build_scene does, with the same problems in the same words and the same numbers to the last
/// bit. Specs that differ in what their mesh does not depend on (speed, strains, contact, steps, output) share what is
/// known of it: the first builds it, the others cost microseconds. Keeps what is known of the last meshes, not the
/// meshes. Not thread-safe.
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
    /// As SceneFacts has it, or more by the faces of a mesh that is searched by buckets after all; 0 when there are
    /// problems.
    std::int64_t most_memory_bytes = 0;
  };
  Verdict check(const SceneSpec& given);

  /// From now on the mesh of a spec from which `scene` was built is known.
  void know(const SceneSpec& given, const Scene& scene);

  /// Elements of the mesh that check(given) would build, without building it: about as many as it has. 0 where it would
  /// build none.
  [[nodiscard]] std::int64_t elements_to_build(const SceneSpec& given) const;

 private:
  struct KnownMesh;
  [[nodiscard]] const KnownMesh* find_known(const SceneSpec& part) const;
  const KnownMesh& mesh_of(SceneSpec part);
  void keep(std::unique_ptr<KnownMesh> mesh);

  std::deque<std::unique_ptr<KnownMesh>> known_;  ///< the newest first
};

}  // namespace cellcrush
