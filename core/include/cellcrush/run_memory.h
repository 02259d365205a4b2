#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

// The memory of a run, predicted: the bytes that become resident from before the scene is built until the crush ends.
// They are proportional to the elements, so a specimen of a few cells of the same spec is built, and its bytes are
// scaled; a frame is counted as it is.
//
// Counted: the arrays of scene and state, by the lists that checkpoint, hash and large pages go by; candidates and
// touches, which grow as the lattice is shortened (scene/shortening.h); cells, columns and frames; the heap's reserve.
// Not counted: the program, its libraries and threads; samples and frames that a caller keeps; scratch of a second
// thread; what sorts or builds for a while.
//
// tests/core/memory/run_memory_test.cpp holds the prediction against resident bytes.

/// Memory of a run, bytes. REQUIRES: `scene` was built from `spec`.
std::int64_t memory_of_run(const SceneSpec& spec, const Scene& scene);

/// Size of a checkpoint at the end of a run, bytes. REQUIRES: as above.
std::int64_t checkpoint_of_run(const SceneSpec& spec, const Scene& scene);

/// memory_of_run before the scene is built, or more: contacts may be searched by buckets after all, and a lattice that
/// is cut into bands needs less. REQUIRES: a spec without problems, and the number of its elements.
std::int64_t most_memory_of_run(const SceneSpec& spec, std::int64_t elements);

/// The same for many specs: those of one lattice share a specimen, whatever their imperfections and numbers of cells
/// above eight at one strain rate. Not thread-safe.
class MemoryForecast {
 public:
  std::int64_t most_of_run(const SceneSpec& spec, std::int64_t elements);

 private:
  SceneSpec specimen_;             ///< the last one
  double bytes_of_element_ = 0.0;  ///< 0: there is none
};

}  // namespace cellcrush
