#include "contact/contact_forces.h"

#include <algorithm>
#include <vector>

#include "contact/find_touches.h"
#include "contact/friction.h"
#include "contact/normal_force.h"

namespace cellcrush {
namespace {

/// Adds a force on the ball and its reaction on the segment, shared by the lever rule.
void add_pair(const Scene& scene, const Touch& touch, const Vector2& force, std::vector<Vector2>& forces) {
  const Element& element = scene.elements[touch.segment];
  forces[touch.ball] += force;
  forces[element.start] -= (1.0 - touch.share) * force;
  forces[element.end] -= touch.share * force;
}

/// Velocity of the segment where it touches the ball.
Vector2 segment_velocity(const Scene& scene, const State& state, const Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  return (1.0 - touch.share) * state.velocity[element.start] + touch.share * state.velocity[element.end];
}

/// Takes back half of what the touch of two balls would store: the node's ball counts the pair as well, and pushes on its
/// own where the node lies under the ball's segments.
void take_back_node(const Scene& scene, State& state, const Touch& touch) {
  if (touch.node < 0) {
    return;
  }
  const double stiffness = 0.5 * scene.contact.stiffness;
  const Vector2 force = stiffness * touch.node_depth * touch.node_normal;
  state.contact_force[touch.ball] -= force;
  state.contact_force[touch.node] += force;
  state.contact_stored -= 0.5 * stiffness * touch.node_depth * touch.node_depth;
}

/// Adds the normal force of a touch; returns what of it friction goes by, N.
double apply_normal_force(const Scene& scene, State& state, const Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  const double to_end = touch.share;
  const double to_start = 1.0 - touch.share;
  const double rate = touch.normal.dot(segment_velocity(scene, state, touch) - state.velocity[touch.ball]);
  const double inverse_mass = 1.0 / scene.mass[touch.ball] + to_start * to_start / scene.mass[element.start] +
                              to_end * to_end / scene.mass[element.end];
  const NormalForce net = evaluate_normal_force(scene.contact.stiffness, scene.contact.damping_ratio, inverse_mass,
                                                touch.net_depth, touch.has_pair ? rate : 0.0);
  add_pair(scene, touch, scene.contact.stiffness * touch.depth * touch.normal, state.contact_force);
  add_pair(scene, touch, net.viscous * touch.normal, state.contact_damping_force);
  state.contact_stored += 0.5 * scene.contact.stiffness * touch.depth * touch.depth;
  take_back_node(scene, state, touch);
  ++state.contact_count;
  const double relative_depth = touch.depth / std::min(2.0 * scene.radius[touch.ball], element.thickness);
  state.deepest_penetration = std::max(state.deepest_penetration, relative_depth);
  if (touch.is_new) {
    state.deepest_birth = std::max(state.deepest_birth, relative_depth);
  }
  return net.elastic + net.viscous;
}

/// Along the segment where the ball touches its side, turned with the normal round its ends.
Vector2 tangent_of(const State& state, const Touch& touch) {
  const int side = state.touching[touch.memory].side;
  return side * Vector2(touch.normal.y(), -touch.normal.x());
}

/// Whether a pair pushes with friction in this step.
bool rubs(const std::vector<Touch>& pushing, const ContactMemory& pair) {
  const auto precedes = [](const Touch& touch, const ContactMemory& other) {
    return touch.ball != other.ball ? touch.ball < other.ball : touch.segment < other.segment;
  };
  const auto found = std::lower_bound(pushing.begin(), pushing.end(), pair, precedes);
  return found != pushing.end() && found->ball == pair.ball && found->segment == pair.segment && found->has_pair;
}

/// Friction that a touch takes over: its own, or that of a touch which it follows. A ball slides on from a neighbour; of two
/// balls the one hands over to the other. All run along the polyline, one way on its left and the other on its right.
/// `before`: what touched in the step before.
double friction_before(const Scene& scene, const State& state, const Touch& touch, const std::vector<Touch>& pushing,
                       const std::vector<ContactMemory>& before) {
  const ContactMemory& own = state.touching[touch.memory];
  if (own.pushed != 0) {
    return own.friction * own.pushed * own.side;
  }
  const auto handed_over = [&](int ball, const auto& follows) {
    const auto precedes = [](const ContactMemory& memory, int other) { return memory.ball < other; };
    auto other = std::lower_bound(before.begin(), before.end(), ball, precedes);
    for (; other != before.end() && other->ball == ball; ++other) {
      if (other->pushed != 0 && !rubs(pushing, *other) && follows(scene.elements[other->segment])) {
        return other->friction * other->pushed * own.side;
      }
    }
    return 0.0;
  };
  const double of_neighbour =
      handed_over(touch.ball, [&](const Element& other) { return share_a_node(other, scene.elements[touch.segment]); });
  if (of_neighbour != 0.0 || touch.node < 0) {
    return of_neighbour;
  }
  return handed_over(touch.node,
                     [&](const Element& other) { return other.start == touch.ball || other.end == touch.ball; });
}

/// Overwrites the friction of all that touch by that of the touches that push now, and adds the forces.
void apply_friction(const Scene& scene, State& state, const std::vector<Touch>& pushing,
                    const std::vector<ContactMemory>& before, const std::vector<double>& normal_forces) {
  std::vector<double> friction;
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    const Touch& touch = pushing[i];
    const Vector2 slide = state.velocity[touch.ball] - segment_velocity(scene, state, touch);
    const double slip = scene.schedule.time_step * slide.dot(tangent_of(state, touch));
    friction.push_back(evaluate_friction(friction_before(scene, state, touch, pushing, before), scene.contact.stiffness,
                                         slip, scene.contact.friction * normal_forces[i]));
  }
  for (ContactMemory& memory : state.touching) {
    memory.pushed = 0;
    memory.friction = 0.0;
  }
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    ContactMemory& memory = state.touching[pushing[i].memory];
    memory.pushed = pushing[i].has_pair ? memory.side : 0;
    memory.friction = friction[i];
    add_pair(scene, pushing[i], friction[i] * tangent_of(state, pushing[i]), state.friction_force);
  }
}

}  // namespace

void evaluate_contact_forces(const Scene& scene, State& state) {
  std::fill(state.friction_force.begin(), state.friction_force.end(), Vector2::Zero());
  std::fill(state.contact_force.begin(), state.contact_force.end(), Vector2::Zero());
  std::fill(state.contact_damping_force.begin(), state.contact_damping_force.end(), Vector2::Zero());
  state.contact_stored = 0.0;
  state.contact_count = 0;
  const std::vector<ContactMemory> before =
      scene.contact.friction > 0.0 ? state.touching : std::vector<ContactMemory>();
  const std::vector<Touch> pushing = find_touches(scene, state);
  std::vector<double> normal_forces;
  normal_forces.reserve(pushing.size());
  for (const Touch& touch : pushing) {
    normal_forces.push_back(apply_normal_force(scene, state, touch));
  }
  if (scene.contact.friction > 0.0) {
    apply_friction(scene, state, pushing, before, normal_forces);
  }
}

}  // namespace cellcrush
