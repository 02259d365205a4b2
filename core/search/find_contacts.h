#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Maintains the list of balls and segments that may touch: no unlisted pair touches now. A ball is at every particle;
/// it is never tested against the elements that end at its particle.
///
/// The search is by faces (E8c, search/face_search.h) where the faces of the scene allow it (scene/contact_faces.h),
/// otherwise by buckets (search/bucket_search.h). From the step in which walls are found to have crossed, it is by
/// buckets.
/// REQUIRES: since the last call, particles have moved by the time step times their velocities.
/// After a non-finite position the list stays as it is; the check of the state stops such a run.
void find_contacts(const Scene& scene, State& state, Workers& workers);

/// Whether the search is still by faces.
bool searches_faces(const Scene& scene, const State& state);

/// Whether the search was by faces and no longer is.
bool has_left_faces(const Scene& scene, const State& state);

}  // namespace cellcrush
