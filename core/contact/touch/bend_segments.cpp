#include <algorithm>

#include "contact/touch/contact_stages.h"

namespace cellcrush {
namespace {

/// c l of E8e, mm; 0 for elements of rigid bodies and of pairs, of which one node has no rotation.
double bending_length(const Scene& scene, const State& state, int segment) {
  const Element& ends = scene.elements[segment];
  if (segment >= scene.rigid.first_element || scene.inertia[ends.start] == 0.0 || scene.inertia[ends.end] == 0.0) {
    return 0.0;
  }
  const double before = (scene.position[ends.end] - scene.position[ends.start]).norm();
  return std::min(1.0, ends.thickness / before) * state.length[segment];
}

/// c l beta of E8e, mm, towards the ball.
double curve_of(const Scene& scene, const State& state, const TouchMemory& touching, std::size_t touch) {
  const int segment = touching.segment[touch];
  const double bend = bend_of(state, scene.elements[segment]) - touching.bend[touch];
  return touching.side[touch] * bend * bending_length(scene, state, segment);
}

bool is_between_nodes(double share) { return share > 0.0 && share < 1.0; }

}  // namespace

void bend_segments(const Scene& scene, const State& state, const TouchMemory& touching, Touches& touches,
                   std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    const double share = touches.share[i];
    const bool bends = touches.depth[i] > 0.0 && is_between_nodes(share);
    touches.deflection[i] = bends ? share * (1.0 - share) * curve_of(scene, state, touching, i) : 0.0;
    touches.depth[i] += touches.deflection[i];
  }
}

void apply_bending_forces(const Scene& scene, State& state, const TouchMemory& touching,
                          const ContactWorkspace& workspace) {
  const Touches& touches = workspace.touches;
  for (const ActiveContact& contact : workspace.active) {
    const int touch = contact.touch;
    const double share = touches.share[touch];
    if (!is_between_nodes(share)) {
      continue;
    }
    const int segment = touching.segment[touch];
    const double force = contact.share * scene.contact.stiffness * touches.depth[touch];
    const double moment =
        0.5 * force * touching.side[touch] * share * (1.0 - share) * bending_length(scene, state, segment);
    state.contact_moment[touches.start[touch]] -= moment;
    state.contact_moment[touches.end[touch]] += moment;
    // The deflection also depends on the place of the foot and on the length.
    const double inverse_length = state.inverse_length[segment];
    const double slope = (1.0 - share - share) * curve_of(scene, state, touching, touch) * inverse_length;
    const double along = -force * slope;
    const double stretching = -force * touches.deflection[touch] * inverse_length;
    const Vector2& axis = state.axis[segment];
    const Vector2 across = along * touches.offset[touch] * inverse_length * normal_of(axis);
    state.contact_force[touching.ball[touch]].elastic += along * axis;
    state.contact_force[touches.start[touch]].elastic -= ((1.0 - share) * along + stretching) * axis + across;
    state.contact_force[touches.end[touch]].elastic += (stretching - share * along) * axis + across;
  }
}

}  // namespace cellcrush
