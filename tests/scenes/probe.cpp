#include "scenes/probe.h"

#include "contact/contact_forces.h"
#include "contact/contact_tiles.h"
#include "contact/search/pair_search.h"
#include "motion/initial_state.h"
#include "scenes/frames.h"
#include "scenes/near_pairs.h"

namespace cellcrush::scenes {

Probe::Probe(const std::vector<Vector2>& chain, double friction, const std::vector<bool>& reversed) {
  FrameLattice frame;
  for (const Vector2& node : chain) {
    frame.nodes.push_back({node.x(), node.y(), 0.0, 0.0});
  }
  const int count = static_cast<int>(chain.size());
  for (int i = 0; i + 1 < count; ++i) {
    const bool backwards = !reversed.empty() && reversed[i];
    frame.beams.push_back(backwards ? beam(i + 1, i, kThickness, 1) : beam(i, i + 1, kThickness, 1));
  }
  frame.nodes.push_back({0.0, 1000.0, 0.0, 0.0});
  frame.nodes.push_back({0.0, 990.0, 0.0, 0.0});
  frame.beams.push_back(beam(count, count + 1, kThickness, 1));
  frame.self_contact = true;
  SceneSpec spec = elastic_frame(frame);
  spec.contact.damping_ratio = 0.0;
  scene_ = build(spec);
  scene_->contact.friction = friction;
  state_ = place_particles(*scene_);
  tip_ = count + 1;
}

void Probe::place_tip(const Vector2& place, const Vector2& outward) {
  state_.position[tip_] = place;
  state_.position[tip_ - 1] = place + 10.0 * outward;
  state_.axis.back() = -outward;
  state_.length.back() = 10.0;
  list_by_buckets(*scene_, state_, state_.contacts.front());
}

void Probe::evaluate_contacts() {
  clear_contact_forces(state_, 0, static_cast<int>(scene_->particle_count()));
  evaluate_wall_contacts(*scene_, state_, workspace_, workers_);
}

Vector2 Probe::force_at(const Vector2& place, const Vector2& outward) {
  place_tip(place, outward);
  state_.velocity.assign(state_.velocity.size(), Vector2::Zero());
  evaluate_contacts();
  return state_.contact_force[tip_].elastic;
}

Vector2 Probe::drag_to(const Vector2& place, const Vector2& outward) {
  const Vector2 velocity = (place - state_.position[tip_]) / scene_->schedule.time_step;
  place_tip(place, outward);
  for (int i = 0; i <= tip_; ++i) {
    state_.velocity[i] = i < tip_ - 1 ? Vector2(Vector2::Zero()) : velocity;
  }
  evaluate_contacts();
  return state_.friction_force[tip_] + state_.friction_force[tip_ - 1];
}

}  // namespace cellcrush::scenes
