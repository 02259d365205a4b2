#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cellcrush/breaks.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "fracture/failure.h"

namespace cellcrush {

// How a wall breaks (E6g): at the start of the next path element, as the method has it. The end of the wall becomes a
// particle of its own, with the share of the mass that the wall gave to its joint, and with the place and the velocity
// of the joint. Mass, momentum and energy stay the same. No section changes: the freed end unloads by its own motion.
// New joints stand behind the old ones; elements, walls and their order stay as they are.

/// Whether an end can break off after others: something is left at its joint, an element, a mass, or what holds it.
bool can_part(const Scene& scene, std::span<const FailedEnd> others, const FailedEnd& end);

/// The mesh with these ends parted. Its overlaps are those of `before`, renumbered. REQUIRES: Scene::can_break.
std::shared_ptr<Scene> part_mesh(const Scene& before, std::span<const FailedEnd> ends);

/// Adds a break to State::breaks for each end. REQUIRES: a state of `before`.
void note_breaks(const Scene& before, std::span<const FailedEnd> ends, State& state);

/// From a state of `before` to one of `after`, with the forces other than those of walls cleared. REQUIRES: after =
/// part_mesh(before, ends).
void part_state(const Scene& before, const Scene& after, std::span<const FailedEnd> ends, State& state);

/// The motion of the particles that were there before any break, and of the elements, in a state of the first mesh.
State without_new_ends(const Scene& scene, const State& state);

/// The mesh after breaks that have been noted, before any overlap of new ends.
std::shared_ptr<Scene> part_again(const Scene& first, std::span<const Break> breaks);

}  // namespace cellcrush
