// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_MOTION_MOTION_WORKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_MOTION_MOTION_WORKS_INL_H_
#undef CELLCRUSH_MOTION_MOTION_WORKS_INL_H_
#else
#define CELLCRUSH_MOTION_MOTION_WORKS_INL_H_
#endif

#include <cstddef>

#include "motion/motion_works.h"
#include "motion/particle_motion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Works of the forces on the particles of the lanes; see MotionWorks.
template <class D>
struct LaneWorks {
  Lane<D> contact;
  Lane<D> contact_damping;
  Lane<D> friction;
  Lane<D> mass_damping;
  Lane<D> external;
  Lane<D> twice_kinetic;
};

/// The same for all lanes over which works are summed.
struct WorkSums {
  double contact[kSumLanes] = {};
  double contact_damping[kSumLanes] = {};
  double friction[kSumLanes] = {};
  double mass_damping[kSumLanes] = {};
  double external[kSumLanes] = {};
  double twice_kinetic[kSumLanes] = {};

  template <class D>
  HWY_INLINE LaneWorks<D> load(int lane) const {
    const auto at = [lane](const double* sums) HWY_ATTR { return Lane<D>::load(sums + lane); };
    return {at(contact), at(contact_damping), at(friction), at(mass_damping), at(external), at(twice_kinetic)};
  }

  template <class D>
  HWY_INLINE void store(int lane, const LaneWorks<D>& works) {
    works.contact.store(contact + lane);
    works.contact_damping.store(contact_damping + lane);
    works.friction.store(friction + lane);
    works.mass_damping.store(mass_damping + lane);
    works.external.store(external + lane);
    works.twice_kinetic.store(twice_kinetic + lane);
  }

  [[nodiscard]] HWY_INLINE MotionWorks total() const {
    const auto sum_of = [](const double* lanes) HWY_ATTR {
      double sum = 0.0;
      for (int lane = 0; lane < kSumLanes; ++lane) {
        sum += lanes[lane];
      }
      return sum;
    };
    return {sum_of(contact),      sum_of(contact_damping), sum_of(friction),
            sum_of(mass_damping), sum_of(external),        sum_of(twice_kinetic)};
  }
};

/// Adds the works of the forces over a mean displacement, mm, and a mean rotation, rad (E10).
template <bool kContact, class Kinds, class D, class S>
HWY_INLINE void add_works(const ParticleArrays<S>& arrays, const StepFactors& step, std::size_t i,
                          const ParticleForces<D>& forces, const ParticleMotion<D>& motion,
                          const Points<D>& displacement, Lane<D> turn, LaneWorks<D>& works) {
  if constexpr (kContact) {
    works.contact -= dot(forces.elastic, displacement);
    works.contact_damping -= dot(forces.viscous, displacement);
  }
  if constexpr (kContact && Kinds::kFrame) {
    works.contact = fnma(forces.contact_moment, turn, works.contact);
  }
  if constexpr (Kinds::kFriction) {
    works.friction -= dot(forces.friction, displacement);
  }
  if constexpr (Kinds::kMassDamping) {
    const Lane<D> damping = -step.half_damping;
    const Points<D> force = damping * Lane<D>::load(arrays.mass + i) * (motion.velocity + motion.next);
    const Lane<D> moment = damping * Lane<D>::load(arrays.inertia + i) * (motion.spin + motion.next_spin);
    works.mass_damping -= dot(force, displacement);
    works.mass_damping = fnma(moment, turn, works.mass_damping);
  }
  if constexpr (Kinds::kFrame) {
    works.external += fma(forces.load_moment, turn, dot(forces.load, displacement));
    works.external += fma(motion.reaction_moment, turn, dot(motion.reaction, displacement));
  }
}

/// Adds the works over the step, of which the mean velocity is half of the sum of the two velocities.
template <bool kContact, class Kinds, class D, class S>
HWY_INLINE void add_works_of_step(const ParticleArrays<S>& arrays, const StepFactors& step, std::size_t i,
                                  const ParticleForces<D>& forces, const ParticleMotion<D>& motion,
                                  LaneWorks<D>& works) {
  const Lane<D> half = 0.5 * step.step;
  add_works<kContact, Kinds>(arrays, step, i, forces, motion, half * (motion.velocity + motion.next),
                             half * (motion.spin + motion.next_spin), works);
}

/// Adds the works over the half step up to the time of the forces, and twice the kinetic energy at that time.
template <class Kinds, class D, class S>
HWY_INLINE void add_works_of_half_step(const ParticleArrays<S>& arrays, const StepFactors& step, std::size_t i,
                                       const ParticleForces<D>& forces, const ParticleMotion<D>& motion,
                                       LaneWorks<D>& works) {
  const Lane<D> half = 0.5 * step.step;
  add_works<true, Kinds>(arrays, step, i, forces, motion, half * motion.velocity, half * motion.spin, works);
  const Lane<D> of_spin = Lane<D>::load(arrays.inertia + i) * (motion.spin * motion.next_spin);
  works.twice_kinetic += fma(Lane<D>::load(arrays.mass + i), dot(motion.velocity, motion.next), of_spin);
}

/// Calls visit(tag of the lanes, first particle, their works) for all particles from `first` to `end` and sums the
/// works. These stay in registers; in memory, each would have to wait until the one before is written.
template <std::size_t kWidth, class Visit>
HWY_INLINE MotionWorks sum_works(std::size_t first, std::size_t end, Visit&& visit) {
  using Wide = WideTag<double, kWidth>;
  using One = hn::CappedTag<double, 1>;
  constexpr int kLanes = static_cast<int>(Lane<Wide>::kWidth);
  constexpr int kGroups = kSumLanes / kLanes;
  WorkSums sums;
  LaneWorks<Wide> works[kGroups];
  for (LaneWorks<Wide>& work : works) {
    work = sums.load<Wide>(0);
  }
  std::size_t i = first;
  for (; i + kSumLanes <= end; i += kSumLanes) {
    for (int group = 0; group < kGroups; ++group) {
      visit(Wide(), i + group * kLanes, works[group]);
    }
  }
  for (int group = 0; group < kGroups; ++group) {
    sums.store(group * kLanes, works[group]);
  }
  for (int lane = 0; i < end; ++i, ++lane) {
    LaneWorks<One> work = sums.load<One>(lane);
    visit(One(), i, work);
    sums.store(lane, work);
  }
  return sums.total();
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_MOTION_MOTION_WORKS_INL_H_
