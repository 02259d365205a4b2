#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Keeps the list of balls and segments that may touch: no pair that is not listed touches now. A ball stands at every
/// particle; it is never held against the elements that end at it.
///
/// By faces (search/face_search.h) where the scene's faces allow it (scene/contact_faces.h), else by buckets
/// (search/bucket_search.h); from the step on in which walls are found to have crossed, by buckets.
/// REQUIRES: particles have moved by the time step times their velocities since the call before.
/// After a non-finite position the list is left as it is; the run is stopped by its check of the state.
void find_contacts(const Scene& scene, State& state, Workers& workers);

/// Whether it goes by faces still.
bool searches_faces(const Scene& scene, const State& state);

/// Whether it did and no longer does.
bool has_left_faces(const Scene& scene, const State& state);

}  // namespace cellcrush
