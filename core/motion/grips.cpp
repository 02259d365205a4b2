#include "motion/grips.h"

namespace cellcrush {

Vector2 displacement_of(const Scene& scene, const State& state, const Grip& grip) {
  const int any = scene.particles_of(grip).front();
  return state.position[any] - scene.position[any];
}

Vector2 impulse_of(const Scene& scene, const State& state, const Grip& grip) {
  Vector2 sum = Vector2::Zero();
  for (const int particle : scene.particles_of(grip)) {
    const ReactionImpulse& impulse = state.reaction_impulse[particle];
    sum += Vector2(impulse.x, impulse.y);
  }
  return sum;
}

}  // namespace cellcrush
