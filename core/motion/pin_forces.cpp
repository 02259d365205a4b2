#include "motion/pin_forces.h"

namespace cellcrush {
namespace {

template <class Forces>
void share(const Pins& pins, Forces& forces) {
  for (std::size_t pin = 0; pin < pins.count(); ++pin) {
    Vector2 sum = Vector2::Zero();
    for (const int joint : pins.joints_of(pin)) {
      sum += forces[joint];
    }
    const Vector2 each = sum / static_cast<double>(pins.joints_of(pin).size());
    for (const int joint : pins.joints_of(pin)) {
      forces[joint] = each;
    }
  }
}

}  // namespace

void share_pin_forces(const Scene& scene, State& state) {
  share(scene.pins, state.internal_force);
  if (!state.load_force.empty()) {
    share(scene.pins, state.load_force);
  }
}

}  // namespace cellcrush
