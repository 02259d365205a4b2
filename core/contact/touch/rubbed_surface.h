#pragma once

#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// Friction acts where surfaces meet, at a distance from the mid-lines (E9d). The side of a segment turns with it. The
// round surface of a ball turns with the elements that end there, by the mean of their turning weighted by length.
// Nodes inside pairs have no rotation (E5b), so a couple on a surface acts as forces across its elements. These are
// conjugate to the turning: their work is that of the couple, and they have its moment.

/// One of the two surfaces of a contact, or the one at a plate.
struct RubbedSurface {
  std::span<const int> elements;  ///< with which it turns
  double arm;                     ///< mm, from the mid-line to the point of contact
};

/// The elements at a particle: those with which its ball turns.
inline std::span<const int> elements_at(const Scene& scene, int particle) {
  const int first = scene.incidence_offset[particle];
  return {scene.incidence.data() + first, scene.incidence.data() + scene.incidence_offset[particle + 1]};
}

/// Speed of a surface against its mid-line, mm/s, as it turns counter-clockwise.
double speed_by_turning(const Scene& scene, const State& state, const RubbedSurface& surface);

/// Adds the couple of a friction force (N), counter-clockwise, to friction_force. It is the transpose of
/// speed_by_turning: the work of these forces is that of the friction force over the way of the surface.
void add_couple(const Scene& scene, State& state, const RubbedSurface& surface, double force);

/// What the stiffness of friction is divided by on a surface, together with the other: above 1 only where elements are
/// shorter than 1.4 arms. There the couple's forces are greater than friction itself, and would make its spring stiffer
/// than that of the normal force.
double stiffening(const State& state, const RubbedSurface& surface);

}  // namespace cellcrush
