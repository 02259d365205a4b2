// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_MOTION_SUPPORTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_MOTION_SUPPORTS_INL_H_
#undef CELLCRUSH_MOTION_SUPPORTS_INL_H_
#else
#define CELLCRUSH_MOTION_SUPPORTS_INL_H_
#endif

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/particle_motion-inl.h"
#include "motion/plate_motion.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Imposed velocity v_held of a held degree of freedom over the coming step, mm/s or rad/s (E15); 0 if it is held
/// still.
inline double held_velocity(const Scene& scene, const State& state, const Hold& hold) {
  if (hold.motion == Hold::kStill) {
    return 0.0;
  }
  const double time = state.time;
  const double step = scene.schedule.time_step;
  if (hold.motion == Hold::kWithImpactPlate) {
    return plate_speed_at(scene, state, time + 0.5 * step);
  }
  const TimeFunction& motion = scene.motions[hold.motion];
  return (motion.value_at(time + step) - motion.value_at(time)) / step;
}

/// Replaces the free velocities of held degrees of freedom by the imposed ones, and computes the reactions (E15).
template <class D, class S>
HWY_INLINE void apply_supports(const ParticleArrays<S>& arrays, const StepFactors& step, std::size_t i,
                               ParticleMotion<D>& motion) {
  static_assert(Lane<D>::kWidth == 1);
  const double mass_per_gain = arrays.mass[i] / step.gain;
  const auto hold = [&](const Hold& support, double per_velocity, Lane<D>& velocity, Lane<D>& reaction) HWY_ATTR {
    if (support.held) {
      const Lane<D> held = held_velocity(arrays.scene, arrays.state, support);
      reaction = Lane<D>(per_velocity) * (held - velocity);
      velocity = held;
    }
  };
  const Support& support = arrays.scene.supports[i];
  hold(support.x, mass_per_gain, motion.next.x, motion.reaction.x);
  hold(support.y, mass_per_gain, motion.next.y, motion.reaction.y);
  hold(support.rotation, arrays.inertia[i] / step.gain, motion.next_spin, motion.reaction_moment);
}

/// Adds the impulses of the supports of a particle over a step.
template <class D>
HWY_INLINE void add_reactions(const ParticleArrays<State>& arrays, const StepFactors& step, std::size_t i,
                              const ParticleMotion<D>& motion) {
  if (!arrays.scene.supports.empty()) {
    ReactionImpulse& impulse = arrays.reaction_impulse[i];
    impulse.x += step.step * hn::GetLane(motion.reaction.x.raw);
    impulse.y += step.step * hn::GetLane(motion.reaction.y.raw);
    impulse.moment += step.step * hn::GetLane(motion.reaction_moment.raw);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_MOTION_SUPPORTS_INL_H_
