#include "motion/loads.h"

#include <algorithm>

#include "contact/contact_tiles.h"

namespace cellcrush {
namespace {

void add_to(State& state, int node, Component component, double value) {
  switch (component) {
    case Component::x: state.load_force[node].x() += value; break;
    case Component::y: state.load_force[node].y() += value; break;
    case Component::rotation: state.load_moment[node] += value; break;
  }
}

/// Half of the load on either node, and the end moments of a clamped beam due to its component perpendicular to the
/// element (E14).
void add_element_load(const Scene& scene, State& state, const ElementLoad& load) {
  const Element& element = scene.elements[load.element];
  const double total = load.value.value_at(state.time) * load.length;
  add_to(state, element.start, load.component, 0.5 * total);
  add_to(state, element.end, load.component, 0.5 * total);
  const Vector2 normal = normal_of(state.axis[load.element]);
  const double across = total * (load.component == Component::x ? normal.x() : normal.y());
  const double moment = across * state.length[load.element] / 12.0;
  state.load_moment[element.start] += moment;
  state.load_moment[element.end] -= moment;
}

/// force_on(joint): a Vector2&.
template <class ForceOn>
void share(const Pins& pins, const ForceOn& force_on) {
  for (std::size_t pin = 0; pin < pins.count(); ++pin) {
    Vector2 sum = Vector2::Zero();
    for (const int joint : pins.joints_of(pin)) {
      sum += force_on(joint);
    }
    const Vector2 each = sum / static_cast<double>(pins.joints_of(pin).size());
    for (const int joint : pins.joints_of(pin)) {
      force_on(joint) = each;
    }
  }
}

/// The forces of walls, plates and half planes on the balls of a pin.
void share_contact_forces(const Pins& pins, State& state) {
  share(pins, [&](int joint) -> Vector2& { return state.contact_force[joint].elastic; });
  share(pins, [&](int joint) -> Vector2& { return state.contact_force[joint].viscous; });
  if (!state.friction_force.empty()) {
    share(pins, [&](int joint) -> Vector2& { return state.friction_force[joint]; });
  }
  for (const int joint : pins.joint) {
    const ContactForce& force = state.contact_force[joint];
    const bool rubs = !state.friction_force.empty() && !state.friction_force[joint].isZero(0.0);
    if (rubs || !force.elastic.isZero(0.0) || !force.viscous.isZero(0.0)) {
      mark_contact_tile(state, joint);
    }
  }
}

}  // namespace

void evaluate_loads(const Scene& scene, State& state) {
  if (!scene.is_loaded()) {
    return;
  }
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    state.load_force[i] = scene.mass[i] * scene.gravity;
    state.load_moment[i] = 0.0;
  }
  for (const NodalLoad& load : scene.loads) {
    add_to(state, load.node, load.component, load.value.value_at(state.time));
  }
  for (const ElementLoad& load : scene.element_loads) {
    add_element_load(scene, state, load);
  }
}

void share_pin_forces(const Scene& scene, State& state) {
  if (scene.pins.count() == 0) {
    return;
  }
  share(scene.pins, [&](int joint) -> Vector2& { return state.internal_force[joint]; });
  if (!state.load_force.empty()) {
    share(scene.pins, [&](int joint) -> Vector2& { return state.load_force[joint]; });
  }
  share_contact_forces(scene.pins, state);
}

}  // namespace cellcrush
