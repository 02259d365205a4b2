#pragma once

#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

// The search for balls and segments that may touch. A ball is at every particle; it is never tested against the
// elements that end at its particle. Where the faces of the scene allow it (contact/topology/face_loops.h), the search
// is by faces (E8c), otherwise by buckets; both are in contact/search/pair_search.h. This is the only place that
// chooses between them and that switches.

namespace cellcrush {

/// Maintains the list of pairs: no unlisted pair touches now. If walls are found to have crossed, state.crossing_step
/// says when, and the search is by buckets until the run ends.
/// REQUIRES: since the last call, particles have moved by the time step times their velocities.
/// After a non-finite position the list stays as it is; the check of the state stops such a run.
void find_contacts(const Scene& scene, State& state, Workers& workers);

/// The same for one band, whose search is by faces. Returns false if walls have crossed. REQUIRES: searches_faces at
/// the start of the steps. The caller reports a crossing by change_topology when no step is in progress.
bool find_band_contacts(const Scene& scene, State& state, std::size_t band, Workers& workers);

/// What no longer holds of the faces of a scene.
enum class TopologyChange {
  walls_crossed,  ///< walls have crossed, which a search has found
  borders_near,   ///< parts of the outer border that bands search separately may touch
  walls_changed,  ///< walls have parted or joints have merged
};

/// Tells the search that the topology changed in `step`. Touching pairs are kept in either case.
///
/// After walls_crossed and borders_near the search is by buckets. After walls_changed it starts again, by faces where
/// those of the scene are enough and the lattice is one band, otherwise by buckets; pairs whose ball has become an end
/// of its segment are released. REQUIRES of walls_changed: elements, incidence, limited reaches and faces of the scene
/// are those after the change; particles and elements keep their numbers.
void change_topology(const Scene& scene, State& state, TopologyChange change, std::int64_t step);

/// Whether the search is still by faces.
bool searches_faces(const Scene& scene, const State& state);

/// Whether the search was by faces and no longer is.
bool has_left_faces(const Scene& scene, const State& state);

/// At the outer face, balls of a band are tested against the segments of its own part of the border and of its
/// neighbours only (FacesOfBand::is_outer_whole). Returns in how many steps, `most` at most, no parts of bands that are
/// not adjacent can touch, unless speeds at the border more than double; 0 if some may now. Positions that are not
/// finite are ignored; the check of the state stops such a run. REQUIRES: a lattice that is cut into bands.
std::int64_t steps_with_borders_apart(const Scene& scene, const State& state, std::int64_t most);

}  // namespace cellcrush
