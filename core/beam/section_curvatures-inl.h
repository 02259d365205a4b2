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

  [[nodiscard]] HWY_INLINE hn::Vec<D> at(D d, double s) const {
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
  hn::Vec<D> tangent[kSections];

  HWY_INLINE void load(D d, const SectionMemory& memory) {
    for (int i = 0; i < kSections; ++i) {
      unbalance[i] = hn::LoadU(d, &memory.unbalance_of(static_cast<std::size_t>(i)));
      tangent[i] = hn::LoadU(d, &memory.tangent_of(static_cast<std::size_t>(i)));
    }
  }
  HWY_INLINE void store(D d, const SectionMemory& memory) const {
    for (int i = 0; i < kSections; ++i) {
      hn::StoreU(unbalance[i], d, &memory.unbalance_of(static_cast<std::size_t>(i)));
      hn::StoreU(tangent[i], d, &memory.tangent_of(static_cast<std::size_t>(i)));
    }
  }

  /// Lanes whose sections are all elastic and balanced; see is_straight.
  [[nodiscard]] HWY_INLINE hn::Mask<D> is_straight(D d) const {
    auto straight = hn::Eq(tangent[0], tangent[0]);
    for (int i = 0; i < kSections; ++i) {
      straight = hn::And(straight, hn::And(hn::Eq(tangent[i], hn::Set(d, 1.0)), hn::Eq(unbalance[i], hn::Zero(d))));
    }
    return straight;
  }
};

/// See straight_curvatures.
template <int kSections, int kDepthPoints, class D>
HWY_INLINE void straight_curvatures(D d, const RuleFactors<kSections, kDepthPoints>& rule, hn::Vec<D> bend_start,
                                    hn::Vec<D> bend_end, hn::Vec<D>* HWY_RESTRICT curvature) {
  for (int i = 0; i < kSections; ++i) {
    curvature[i] =
        hn::MulAdd(hn::Set(d, rule.bend_start[i]), bend_start, hn::Mul(hn::Set(d, rule.bend_end[i]), bend_end));
  }
}

/// See balanced_curvatures; `active` are the lanes that are asked for, the others' memory is left alone.
template <int kSections, int kDepthPoints, class D>
HWY_INLINE void balanced_curvatures(D d, const RuleFactors<kSections, kDepthPoints>& rule,
                                    const LaneMaterial<D>& material, const LaneMoments<D>& moments, hn::Mask<D> active,
                                    hn::Vec<D> bend_start, hn::Vec<D> bend_end, LaneMemory<kSections, D>& memory,
                                    hn::Vec<D>* HWY_RESTRICT curvature) {
  const auto elastic = hn::Div(hn::Set(d, 12.0), material.modulus);
  const auto round_off = hn::Mul(hn::Set(d, kSectionRoundOff), material.modulus);
  for (bool turned_back = true; turned_back;) {
    auto start = hn::Zero(d);
    auto mixed = hn::Zero(d);
    auto end = hn::Zero(d);
    auto lacks_start = hn::Zero(d);
    auto lacks_end = hn::Zero(d);
    hn::Vec<D> flexibility[kSections];
    for (int i = 0; i < kSections; ++i) {
      const double s = rule.along[i];
      flexibility[i] = hn::Div(elastic, memory.tangent[i]);
      const auto weighted = hn::Mul(hn::Set(d, rule.along_weight[i]), flexibility[i]);
      start = hn::MulAdd(weighted, hn::Set(d, (1.0 - s) * (1.0 - s)), start);
      mixed = hn::NegMulAdd(weighted, hn::Set(d, (1.0 - s) * s), mixed);
      end = hn::MulAdd(weighted, hn::Set(d, s * s), end);
      const auto lacks = hn::Mul(weighted, memory.unbalance[i]);
      lacks_start = hn::MulAdd(lacks, hn::Set(d, 1.0 - s), lacks_start);
      lacks_end = hn::NegMulAdd(lacks, hn::Set(d, s), lacks_end);
    }
    const auto a = hn::Sub(bend_start, lacks_start);
    const auto b = hn::Sub(bend_end, lacks_end);
    const auto inverse = hn::Div(hn::Set(d, 1.0), hn::MulSub(start, end, hn::Mul(mixed, mixed)));
    const LaneMoments<D> increment = {hn::Mul(inverse, hn::MulSub(end, a, hn::Mul(mixed, b))),
                                      hn::Mul(inverse, hn::MulSub(start, b, hn::Mul(mixed, a)))};
    turned_back = false;
    for (int i = 0; i < kSections; ++i) {
      const double s = rule.along[i];
      curvature[i] = hn::Mul(flexibility[i], hn::Add(increment.at(d, s), memory.unbalance[i]));
      const auto moment = hn::Sub(moments.at(d, s), memory.unbalance[i]);
      const auto turns_back = hn::And(
          hn::And(active, hn::Gt(hn::Abs(moment), round_off)),
          hn::And(hn::Lt(memory.tangent[i], hn::Set(d, 1.0)), hn::Lt(hn::Mul(curvature[i], moment), hn::Zero(d))));
      memory.tangent[i] = hn::IfThenElse(turns_back, hn::Set(d, 1.0), memory.tangent[i]);
      turned_back = turned_back || !hn::AllFalse(d, turns_back);
    }
  }
}

/// See remember_sections; returns the lanes that are in balance.
template <int kSections, int kDepthPoints, class D>
HWY_INLINE hn::Mask<D> remember_sections(D d, const RuleFactors<kSections, kDepthPoints>& rule,
                                         const LaneMaterial<D>& material, const hn::Vec<D>* HWY_RESTRICT before,
                                         const LaneSums<kSections, D>& now, const hn::Vec<D>* HWY_RESTRICT curvature,
                                         hn::Mask<D> active, LaneMemory<kSections, D>& memory) {
  const auto round_off = hn::Mul(hn::Set(d, kSectionRoundOff), material.modulus);
  auto worst = hn::Zero(d);
  for (int i = 0; i < kSections; ++i) {
    const auto elastic = hn::Mul(hn::Mul(material.modulus, hn::Set(d, 1.0 / 12.0)), curvature[i]);
    const auto share = hn::Div(hn::Sub(now.moment[i], before[i]), elastic);
    const auto tangent = hn::IfThenElse(hn::Gt(share, hn::Set(d, 1.0 - 1e-6)), hn::Set(d, 1.0),
                                        hn::Max(share, hn::Set(d, kLeastTangent)));
    const auto moves = hn::And(active, hn::Gt(hn::Abs(elastic), round_off));
    memory.tangent[i] = hn::IfThenElse(moves, tangent, memory.tangent[i]);
    const auto unbalance = hn::Sub(now.moments.at(d, rule.along[i]), now.moment[i]);
    const auto size = hn::Abs(unbalance);
    const auto kept = hn::IfThenElseZero(hn::Gt(size, round_off), unbalance);
    memory.unbalance[i] = hn::IfThenElse(active, kept, memory.unbalance[i]);
    worst = hn::Max(worst, size);
  }
  return hn::Le(worst, hn::Mul(hn::Set(d, 0.25 * kInBalance), material.yield_stress));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_SECTION_CURVATURES_INL_H_
