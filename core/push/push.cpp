#include "push/push.h"

#include <algorithm>
#include <array>

#include "push/press_ball-inl.h"

namespace cellcrush {

extern const Pusher kPlates;
extern const Pusher kHalfPlanes;

namespace {

/// 1 / tonne of what a ball moves: of a joint that has an image, both.
double inverse_mass_of(const Scene& scene, int particle) {
  return scene.repeated == nullptr ? scene.inverse_mass[particle]
                                   : scene.repeated->inverse_mass[scene.repeated->first_ball + particle];
}

}  // namespace

FaceForce push_by_face(const Scene& scene, State& state, const Face& face, int particle, double radius) {
  const double distance = face.distance_of(state.position[particle]);
  FaceForce sum =
      HWY_NAMESPACE::press_ball(scene, state, face, particle, radius - distance, inverse_mass_of(scene, particle));
  if (face.friction_of != nullptr && (distance < radius || face.friction_of[particle] != 0.0)) {
    sum.tangential =
        HWY_NAMESPACE::rub(scene, state, face, particle, distance, face.friction * (sum.elastic + sum.viscous));
  }
  return sum;
}

std::span<const Pusher* const> pushers() {
  static constexpr std::array kPushers = {&kPlates, &kHalfPlanes};
  return kPushers;
}

}  // namespace cellcrush
