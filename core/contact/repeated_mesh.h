#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// Contacts across sides that repeat (E9i). The mesh stands between copies of itself at either side, its images joined
// to the joints of the next copy. Balls of the mesh touch segments of all copies, so that each contact is found once.
// The forces on a copy are those on the mesh, and act on the width as many times as it is periods away.

/// Sets the copies as the mesh stands, clears their forces, and hands them the lists of contacts.
void begin_repeated_contacts(const Scene& scene, State& state, State& repeated);

/// Takes the lists back, and adds the forces of the copies to those of the mesh and of the width.
void end_repeated_contacts(const Scene& scene, State& repeated, State& state, SideForce& on_width);

/// Where the particles of the repeated mesh are now.
std::vector<Vector2> repeated_positions(const Scene& scene, const State& state);

/// Whether the mesh has grown so wide across the crush that contacts with copies further away could be missed.
bool outgrows_copies(const Scene& scene, const State& state);

}  // namespace cellcrush
