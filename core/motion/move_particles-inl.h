// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_MOTION_MOVE_PARTICLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_MOTION_MOVE_PARTICLES_INL_H_
#undef CELLCRUSH_MOTION_MOVE_PARTICLES_INL_H_
#else
#define CELLCRUSH_MOTION_MOVE_PARTICLES_INL_H_
#endif

#include <cstddef>

#include "motion/motion_works-inl.h"
#include "motion/particle_motion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Moves the particles of the lanes over a step (E2) and adds the works of the forces. `notes` takes the new positions.
template <bool kContact, class Kinds, class D, class Notes>
HWY_INLINE void move(const ParticleArrays<State>& arrays, const StepFactors& step, std::size_t i, LaneWorks<D>& works,
                     Notes& notes) {
  const ParticleForces<D> forces = forces_on<kContact, Kinds, D>(arrays, i);
  const ParticleMotion<D> motion = motion_of<Kinds>(arrays, step, forces, i);
  add_works_of_step<kContact, Kinds>(arrays, step, i, forces, motion, works);
  if constexpr (Kinds::kFrame) {
    add_reactions(arrays, step, i, motion);
  }
  const Lane<D> dt = step.step;
  const Points<D> position = fma(dt, motion.next, Points<D>::load(arrays.position + i));
  notes.note(position, i);
  motion.next.store(arrays.velocity + i);
  motion.next_spin.store(arrays.spin + i);
  position.store(arrays.position + i);
  fma(dt, motion.next_spin, Lane<D>::load(arrays.rotation + i)).store(arrays.rotation + i);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_MOTION_MOVE_PARTICLES_INL_H_
