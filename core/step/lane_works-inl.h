// Included once for each target.
#if defined(CELLCRUSH_STEP_LANE_WORKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_STEP_LANE_WORKS_INL_H_
#undef CELLCRUSH_STEP_LANE_WORKS_INL_H_
#else
#define CELLCRUSH_STEP_LANE_WORKS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "simd/lanes-inl.h"
#include "step/wide_motion.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes over which works are summed, whatever the target's are: the sums then have the same bits.
constexpr int kSumLanes = 8;

/// Works of the forces on the lanes' particles; see Ledger.
template <class D>
struct LaneWorks {
  hn::Vec<D> contact;
  hn::Vec<D> contact_damping;
  hn::Vec<D> friction;
  hn::Vec<D> mass_damping;
  hn::Vec<D> twice_kinetic;
};

/// The same of all lanes over which they are summed.
struct WorkSums {
  double contact[kSumLanes] = {};
  double contact_damping[kSumLanes] = {};
  double friction[kSumLanes] = {};
  double mass_damping[kSumLanes] = {};
  double twice_kinetic[kSumLanes] = {};

  template <class D>
  HWY_INLINE LaneWorks<D> works(D d, int lane) const {
    return {hn::LoadU(d, contact + lane), hn::LoadU(d, contact_damping + lane), hn::LoadU(d, friction + lane),
            hn::LoadU(d, mass_damping + lane), hn::LoadU(d, twice_kinetic + lane)};
  }

  template <class D>
  HWY_INLINE void put(D d, int lane, const LaneWorks<D>& works) {
    hn::StoreU(works.contact, d, contact + lane);
    hn::StoreU(works.contact_damping, d, contact_damping + lane);
    hn::StoreU(works.friction, d, friction + lane);
    hn::StoreU(works.mass_damping, d, mass_damping + lane);
    hn::StoreU(works.twice_kinetic, d, twice_kinetic + lane);
  }
};

HWY_INLINE double sum_of(const double* lanes) {
  double sum = 0.0;
  for (int lane = 0; lane < kSumLanes; ++lane) {
    sum += lanes[lane];
  }
  return sum;
}

HWY_INLINE WorksOfMotion sums_of(const WorkSums& sums) {
  return {sum_of(sums.contact), sum_of(sums.contact_damping), sum_of(sums.friction), sum_of(sums.mass_damping),
          sum_of(sums.twice_kinetic)};
}

/// Subtracts force . displacement from a work.
template <class D>
HWY_INLINE void spend(const Points<D>& force, const Points<D>& displacement, hn::Vec<D>& work) {
  work = hn::Sub(work, dot(force, displacement));
}

/// Calls visit(tag of the lanes, first particle, their works) for all of a chunk and sums the works. They stay in registers:
/// in memory each would wait for the one before to have been written.
template <class Visit>
HWY_INLINE WorksOfMotion sum_over_chunk(std::size_t first, std::size_t end, Visit&& visit) {
  using Wide = hn::CappedTag<double, kSumLanes>;
  using One = hn::CappedTag<double, 1>;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Wide()));
  constexpr int kLots = kSumLanes / kLanes;
  WorkSums sums;
  LaneWorks<Wide> works[kLots];
  for (LaneWorks<Wide>& work : works) {
    work = sums.works(Wide(), 0);
  }
  std::size_t i = first;
  for (; i + kSumLanes <= end; i += kSumLanes) {
    for (int lot = 0; lot < kLots; ++lot) {
      visit(Wide(), i + lot * kLanes, works[lot]);
    }
  }
  for (int lot = 0; lot < kLots; ++lot) {
    sums.put(Wide(), lot * kLanes, works[lot]);
  }
  for (int lane = 0; i < end; ++i, ++lane) {
    LaneWorks<One> work = sums.works(One(), lane);
    visit(One(), i, work);
    sums.put(One(), lane, work);
  }
  return sums_of(sums);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_STEP_LANE_WORKS_INL_H_
