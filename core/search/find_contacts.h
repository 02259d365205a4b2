#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Maintains the list of balls and segments that may touch: no unlisted pair touches now. A ball is at every particle;
/// it is never tested against the elements that end at its particle.
///
/// The search is by faces (E8c, search/face_search.h) where the faces of the scene allow it (scene/contact_faces.h),
/// otherwise by buckets (search/bucket_search.h). Either may find that walls have crossed; state.crossing_step then
/// says when, and the search is by buckets until the run ends.
/// REQUIRES: since the last call, particles have moved by the time step times their velocities.
/// After a non-finite position the list stays as it is; the check of the state stops such a run.
void find_contacts(const Scene& scene, State& state, Workers& workers);

/// The part of find_contacts that is by buckets.
void search_space(const Scene& scene, State& state);

/// Whether the search is still by faces.
bool searches_faces(const Scene& scene, const State& state);

/// Whether the search was by faces and no longer is.
bool has_left_faces(const Scene& scene, const State& state);

}  // namespace cellcrush
