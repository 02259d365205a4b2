#include "push/push.h"

#include <array>

#include "fields/field_checker.h"

namespace cellcrush {

extern const Pusher kPlates;
extern const Pusher kStrikers;
extern const Pusher kRigidWalls;

std::span<const Pusher* const> pushers() {
  static constexpr std::array kPushers = {&kPlates, &kStrikers, &kRigidWalls};
  return kPushers;
}

MotionWorks face_works(const PlateForce& force, double displacement) {
  return {.contact = force.elastic * displacement,
          .contact_damping = force.viscous * displacement,
          .external = force.total() * displacement};
}

std::string friction_words(double coefficient) {
  return coefficient > 0.0 ? "Coulomb friction, coefficient " + to_text(coefficient) + "." : "frictionless.";
}

}  // namespace cellcrush
