#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"
#include "fields/field_checker.h"
#include "push/push.h"

namespace cellcrush {

// What kinds of half planes (LoadsSpec::RigidWall) have in common.

/// Checks those of a spec: normals with a direction, motions with times in order, and what their kinds ask for.
void check_half_planes(const LoadsSpec& loads, FieldChecker& check);

/// Adds those of a checked spec to the scene.
void attach_half_planes(const LoadsSpec& loads, Scene& scene);

/// Problems of walls that stand in a half plane at time 0 (E9f). The first `nodes` particles are nodes of a frame.
Problems find_walls_in_half_planes(const Scene& scene, std::size_t nodes);

/// Calls visit(index, half plane) for those of a kind.
template <class Visit>
void visit_half_planes(const Scene& scene, const Pusher& kind, const Visit& visit) {
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    if (scene.rigid_walls[wall].kind == &kind) {
      visit(wall, scene.rigid_walls[wall]);
    }
  }
}

/// Room in the state for the half planes of all kinds.
void place_half_planes(const Scene& scene, State& state);

/// Presses those of a kind, where they stand in the state, on the particles of a band.
void press_half_planes(const Scene& scene, State& state, const Pusher& kind, const PressedBand& on, ContactSums& sums);

/// Adds the impulses of the forces of a half plane over a step.
void add_impulse(const Scene& scene, State& state, std::size_t wall);

/// "2 half planes", of a kind, "" if there are none; `friction_of` follows them among the facts.
std::string count_words(const Scene& scene, const Pusher& kind);
std::string friction_words(const Scene& scene, const Pusher& kind);

}  // namespace cellcrush
