// Included once for each target. The text of beam/section_curvatures.cpp, a lane an element.
#if defined(CELLCRUSH_BEAM_SECTION_CURVATURES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_SECTION_CURVATURES_INL_H_
#undef CELLCRUSH_BEAM_SECTION_CURVATURES_INL_H_
#else
#define CELLCRUSH_BEAM_SECTION_CURVATURES_INL_H_
#endif

#include <hwy/highway.h>

#include "beam/rule_factors.h"
#include "beam/section_curvatures.h"
#include "section/fibres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// End moments over b h^2 of the lanes; see EndMoments.
template <class D>
struct LaneMoments {
  hn::Vec<D> start;
  hn::Vec<D> end;

  [[nodiscard]] HWY_INLINE hn::Vec<D> at(D d, hn::TFromD<D> s) const {
    return hn::NegMulAdd(hn::Set(d, s), hn::Add(start, end), start);
  }
};

/// What the sections of the lanes' elements sum to; see ElementSums.
template <int kSections, class D>
struct LaneSums {
  hn::Vec<D> axial;
  LaneMoments<D> moments;
  hn::Vec<D> plastic_work;
  hn::Vec<D> moment[kSections];
};

/// What the sections of the lanes' elements remember; see SectionMemory.
template <int kSections, class D>
struct LaneMemory {
  hn::Vec<D> unbalance[kSections];
  hn::Vec<D> flexibility[kSections];

  HWY_INLINE void load(D d, const SectionMemory<hn::TFromD<D>>& memory) {
    for (int i = 0; i < kSections; ++i) {
      unbalance[i] = hn::LoadU(d, &memory.unbalance_of(static_cast<std::size_t>(i)));
      flexibility[i] = hn::LoadU(d, &memory.flexibility_of(static_cast<std::size_t>(i)));
    }
  }
  HWY_INLINE void store(D d, const SectionMemory<hn::TFromD<D>>& memory) const {
    for (int i = 0; i < kSections; ++i) {
      hn::StoreU(unbalance[i], d, &memory.unbalance_of(static_cast<std::size_t>(i)));
      hn::StoreU(flexibility[i], d, &memory.flexibility_of(static_cast<std::size_t>(i)));
    }
  }

  /// Lanes whose sections are all elastic and balanced; see is_straight.
  [[nodiscard]] HWY_INLINE hn::Mask<D> is_straight(D d) const {
    using T = hn::TFromD<D>;
    auto off = hn::Zero(d);
    for (int i = 0; i < kSections; ++i) {
      off = hn::Or(off, hn::Or(hn::Xor(flexibility[i], hn::Set(d, T(1.0))), unbalance[i]));
    }
    return hn::Eq(off, hn::Zero(d));
  }
};

/// See straight_curvatures.
template <int kSections, int kDepthPoints, class D>
HWY_INLINE void straight_curvatures(D d, const RuleFactors<kSections, kDepthPoints, hn::TFromD<D>>& rule,
                                    hn::Vec<D> bend_start, hn::Vec<D> bend_end, hn::Vec<D>* HWY_RESTRICT curvature) {
  for (int i = 0; i < kSections; ++i) {
    curvature[i] =
        hn::MulAdd(hn::Set(d, rule.bend_start[i]), bend_start, hn::Mul(hn::Set(d, rule.bend_end[i]), bend_end));
  }
}

/// See shown_flexibility.
template <class D>
HWY_INLINE hn::Vec<D> shown_flexibility(D d, hn::Vec<D> elastic, hn::Vec<D> gained) {
  using T = hn::TFromD<D>;
  const auto most = hn::Set(d, T(kMostFlexibility));
  const auto flexibility = hn::Div(elastic, gained);
  const auto is_between = hn::And(hn::Gt(flexibility, hn::Zero(d)), hn::Lt(flexibility, most));
  const auto is_elastic = hn::Lt(flexibility, hn::Set(d, kElasticBelow<T>));
  return hn::IfThenElse(is_between, hn::IfThenElse(is_elastic, hn::Set(d, T(1.0)), flexibility), most);
}

/// See balanced_curvatures; `active` are the lanes that are asked for, the others' memory is left alone. Moments are taken
/// as the elastic curvatures that they cause.
template <int kSections, int kDepthPoints, class D>
HWY_INLINE void balanced_curvatures(D d, const RuleFactors<kSections, kDepthPoints, hn::TFromD<D>>& rule,
                                    const LaneMaterial<D>& material, const LaneMoments<D>& moments, hn::Mask<D> active,
                                    hn::Vec<D> bend_start, hn::Vec<D> bend_end, LaneMemory<kSections, D>& memory,
                                    hn::Vec<D>* HWY_RESTRICT curvature) {
  using T = hn::TFromD<D>;
  const auto round_off = hn::Mul(hn::Set(d, kSectionRoundOff<T>), material.yield_stress);
  const auto one = hn::Set(d, T(1.0));
  const auto zero = hn::Zero(d);
  const auto sum = hn::Add(moments.start, moments.end);
  for (bool turned_back = true; turned_back;) {
    auto start = zero;
    auto mixed = zero;
    auto end = zero;
    auto a = bend_start;
    auto b = bend_end;
    for (int i = 0; i < kSections; ++i) {
      start = hn::MulAdd(hn::Set(d, rule.turn_start_start[i]), memory.flexibility[i], start);
      mixed = hn::MulAdd(hn::Set(d, rule.turn_start_end[i]), memory.flexibility[i], mixed);
      end = hn::MulAdd(hn::Set(d, rule.turn_end_end[i]), memory.flexibility[i], end);
      curvature[i] = hn::Mul(hn::Mul(material.bending_flexibility, memory.unbalance[i]), memory.flexibility[i]);
      a = hn::NegMulAdd(hn::Set(d, rule.turn_start[i]), curvature[i], a);
      b = hn::MulAdd(hn::Set(d, rule.turn_end[i]), curvature[i], b);
    }
    const auto inverse = hn::Div(one, hn::MulSub(start, end, hn::Mul(mixed, mixed)));
    const LaneMoments<D> increment = {hn::Mul(inverse, hn::MulAdd(end, a, hn::Mul(mixed, b))),
                                      hn::Mul(inverse, hn::MulAdd(start, b, hn::Mul(mixed, a)))};
    const auto increment_sum = hn::Add(increment.start, increment.end);
    auto any_turned = hn::FirstN(d, 0);
    for (int i = 0; i < kSections; ++i) {
      const auto s = hn::Set(d, rule.along[i]);
      curvature[i] = hn::MulAdd(memory.flexibility[i], hn::NegMulAdd(s, increment_sum, increment.start), curvature[i]);
      const auto moment = hn::Sub(hn::NegMulAdd(s, sum, moments.start), memory.unbalance[i]);
      const auto turns_back =
          hn::And(hn::And(active, hn::Gt(hn::Abs(moment), round_off)),
                  hn::And(hn::Gt(memory.flexibility[i], one), hn::Lt(hn::Mul(curvature[i], moment), zero)));
      memory.flexibility[i] = hn::IfThenElse(turns_back, one, memory.flexibility[i]);
      any_turned = hn::Or(any_turned, turns_back);
    }
    turned_back = !hn::AllFalse(d, any_turned);
  }
}

/// See remember_sections; returns the lanes that are in balance.
template <int kSections, int kDepthPoints, class D>
HWY_INLINE hn::Mask<D> remember_sections(D d, const RuleFactors<kSections, kDepthPoints, hn::TFromD<D>>& rule,
                                         const LaneMaterial<D>& material, const hn::Vec<D>* HWY_RESTRICT before,
                                         const LaneSums<kSections, D>& now, const hn::Vec<D>* HWY_RESTRICT curvature,
                                         hn::Mask<D> active, LaneMemory<kSections, D>& memory) {
  using T = hn::TFromD<D>;
  const auto round_off = hn::Mul(hn::Set(d, kSectionRoundOff<T>), material.yield_stress);
  const auto sum = hn::Add(now.moments.start, now.moments.end);
  auto worst = hn::Zero(d);
  for (int i = 0; i < kSections; ++i) {
    const auto elastic = hn::Mul(hn::Mul(material.modulus, hn::Set(d, T(1.0 / 12.0))), curvature[i]);
    const auto shown = shown_flexibility(d, elastic, hn::Sub(now.moment[i], before[i]));
    const auto moves = hn::And(active, hn::Gt(hn::Abs(elastic), round_off));
    memory.flexibility[i] = hn::IfThenElse(moves, shown, memory.flexibility[i]);
    const auto unbalance = hn::Sub(hn::NegMulAdd(hn::Set(d, rule.along[i]), sum, now.moments.start), now.moment[i]);
    const auto size = hn::Abs(unbalance);
    const auto kept = hn::IfThenElseZero(hn::Gt(size, round_off), unbalance);
    memory.unbalance[i] = hn::IfThenElse(active, kept, memory.unbalance[i]);
    worst = hn::Max(worst, size);
  }
  return hn::Le(worst, hn::Mul(hn::Set(d, T(0.25 * kInBalance)), material.yield_stress));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_SECTION_CURVATURES_INL_H_
