#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// Contacts across sides that repeat (E9i). The mesh stands between copies of itself at either side, its images joined
// to the joints of the next copy. Balls of the mesh touch segments of all copies, so that each contact is found once.
// The forces on a copy are those on the mesh, and act on the width as many times as it is periods away.

/// The mesh with its copies, the furthest on the low side first: its N particles have the numbers of Scene::balls. Of E
/// elements, number e % E of the mesh is e, those of the mesh come first. REQUIRES: sides that repeat, no rigid bodies.
std::shared_ptr<Scene> repeat_mesh(const Scene& scene);

/// Particle of the mesh of which one is a copy.
int original_of(const Scene& scene, int particle);

/// The overlaps of walls of the repeated mesh before loading, of its own balls only, and the same in the numbers of the
/// mesh.
StartOverlaps overlaps_of_balls(const Scene& repeated, const StartOverlaps& all);
StartOverlaps original_overlaps(const Scene& scene, const StartOverlaps& of_balls);

/// Sets the copies as the mesh stands, clears their forces, and hands them the lists of contacts.
void begin_repeated_contacts(const Scene& scene, State& state, State& repeated);

/// Takes the lists back, and adds the forces of the copies to those of the mesh and of the width.
void end_repeated_contacts(const Scene& scene, State& repeated, State& state, SideForce& on_width);

/// Where the particles of the repeated mesh are now.
std::vector<Vector2> repeated_positions(const Scene& scene, const State& state);

/// Whether the mesh has grown so wide across the crush that contacts with copies further away could be missed.
bool outgrows_copies(const Scene& scene, const State& state);

}  // namespace cellcrush
