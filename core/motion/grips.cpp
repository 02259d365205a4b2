#include "motion/grips.h"

namespace cellcrush {
namespace {

/// Along the crush, of all grips that are fixed to a plate.
double impulse_of_fixed(const Scene& scene, const State& state, Grip::FixedTo plate) {
  double sum = 0.0;
  for (const Grip& grip : scene.grips) {
    if (grip.fixed_to == plate) sum += impulse_of(scene, state, grip)[scene.plates.axis];
  }
  return sum;
}

}  // namespace

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

double impact_impulse_of(const Scene& scene, const State& state) {
  return state.impact_impulse + impulse_of_fixed(scene, state, Grip::FixedTo::impact_plate);
}

double support_impulse_of(const Scene& scene, const State& state) {
  return state.support_impulse - impulse_of_fixed(scene, state, Grip::FixedTo::support_plate);
}

}  // namespace cellcrush
