// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_END_TURNS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_END_TURNS_INL_H_
#undef CELLCRUSH_BEAM_END_TURNS_INL_H_
#else
#define CELLCRUSH_BEAM_END_TURNS_INL_H_
#endif

#include <cstddef>

#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// h / l of elements, with l at the start of a step and at its end. h is that at the start in both.
template <class D>
struct Slenderness {
  Lane<D> before;
  Lane<D> now;
};

/// Turns of the ends of elements against their axes since the start, of walls whose bending is coupled with their
/// stretching (E5j). The ends of a pair at its common node, which has no rotation, have half of the turn between its
/// elements each.
template <class D>
class EndTurns {
  using Real = Lane<D>;

 public:
  template <class State>
  HWY_INLINE explicit EndTurns(State& state)
      : start_(state.start_turn.empty() ? nullptr : state.start_turn.data()),
        end_(state.end_turn.empty() ? nullptr : state.end_turn.data()) {}

  [[nodiscard]] HWY_INLINE bool are_coupled() const { return start_ != nullptr; }

  // Each adds the turn of a step and returns the increment of h times the turn over the length.

  HWY_INLINE Real bend_start(std::ptrdiff_t element, Real turn, const Slenderness<D>& of) const {
    return bend(start_ + element, turn, of);
  }

  HWY_INLINE Real bend_end(std::ptrdiff_t element, Real turn, const Slenderness<D>& of) const {
    return bend(end_ + element, turn, of);
  }

  /// At the common node of a pair: `turn` between its elements.
  HWY_INLINE Real bend_between(std::ptrdiff_t first, std::ptrdiff_t second, Real turn, const Slenderness<D>& of_first,
                               const Slenderness<D>& of_second) const {
    const Slenderness<D> both = {of_first.before + of_second.before, of_first.now + of_second.now};
    const Real bent = bend(start_ + second, Real(0.5) * turn, both);
    (-Real::load(start_ + second)).store(end_ + first);
    return bent;
  }

  /// Of the moments at the ends, in the units of the moments: over the length, what they take from the axial force.
  HWY_INLINE Real work_of(std::ptrdiff_t element, Real moment_start, Real moment_end) const {
    return fma(moment_start, Real::load(start_ + element), moment_end * Real::load(end_ + element));
  }

 private:
  HWY_INLINE static Real bend(double* at, Real turn, const Slenderness<D>& of) {
    const Real before = Real::load(at);
    const Real now = before + turn;
    now.store(at);
    return fms(now, of.now, before * of.before);
  }

  double* const start_;
  double* const end_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_END_TURNS_INL_H_
