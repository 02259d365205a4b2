// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
#undef CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
#else
#define CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
#endif

#include <cstddef>

#include "law/fibre_law-inl.h"
#include "section/section_rule.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// A bit for each fibre of the elements of the lanes, and one more that marks an element: 32 bits in single precision,
/// 64 in double precision.
template <class D>
class FibreBits {
  using Unsigned = hn::RebindToUnsigned<D>;

 public:
  using Number = hn::TFromD<Unsigned>;

  HWY_INLINE FibreBits() : raw_(hn::Zero(Unsigned())) {}
  static HWY_INLINE FibreBits load(const Number* from) { return FibreBits(hn::LoadU(Unsigned(), from)); }
  HWY_INLINE void store(Number* to) const { hn::StoreU(raw_, Unsigned(), to); }

  /// Sets the bit of a fibre in the lanes of the mask.
  HWY_INLINE void add(LaneMask<D> lanes, std::size_t fibre) {
    raw_ = hn::Or(raw_, hn::IfThenElseZero(hn::RebindMask(Unsigned(), lanes.raw), bit(fibre)));
  }
  /// Lanes in which the bit of a fibre is set.
  [[nodiscard]] HWY_INLINE LaneMask<D> has(std::size_t fibre) const {
    return {hn::RebindMask(D(), hn::TestBit(raw_, bit(fibre)))};
  }
  HWY_INLINE void mark(LaneMask<D> lanes) { add(lanes, kMark); }
  /// Lanes in which a fibre's bit or the mark is set.
  [[nodiscard]] HWY_INLINE LaneMask<D> lanes() const {
    return {hn::RebindMask(D(), hn::Ne(raw_, hn::Zero(Unsigned())))};
  }
  /// The bits of a section: those of the fibres from `first` on, which become the first.
  [[nodiscard]] HWY_INLINE FibreBits section(std::size_t first, std::size_t count) const {
    return FibreBits(hn::And(hn::ShiftRightSame(raw_, static_cast<int>(first)), lowest(count)));
  }
  HWY_INLINE void add_section(const FibreBits& of, std::size_t first) {
    raw_ = hn::Or(raw_, hn::ShiftLeftSame(of.raw_, static_cast<int>(first)));
  }
  [[nodiscard]] HWY_INLINE FibreBits without_mark() const { return FibreBits(hn::And(raw_, lowest(kMark))); }

  friend HWY_INLINE FibreBits operator|(FibreBits a, FibreBits b) { return FibreBits(hn::Or(a.raw_, b.raw_)); }

 private:
  using Raw = hn::Vec<Unsigned>;

  static constexpr std::size_t kMark = 8 * sizeof(Number) - 1;

  HWY_INLINE explicit FibreBits(Raw raw) : raw_(raw) {}
  static HWY_INLINE Raw lowest(std::size_t count) { return hn::Set(Unsigned(), (Number{1} << count) - 1); }
  static HWY_INLINE Raw bit(std::size_t fibre) { return hn::Set(Unsigned(), Number{1} << fibre); }

  Raw raw_;
};

/// Weighted sums over the fibres of a section: stress, stress times its lever arm (Eq. 28, E7), and the plastic work of
/// the step. MPa.
template <class D>
struct SectionSums {
  Lane<D> axial;
  Lane<D> moment;
  Lane<D> plastic_work;

  HWY_INLINE SectionSums() : axial(0), moment(0), plastic_work(0) {}
};

/// Whether any of several numbers differ in any lane.
template <class D>
class Differences {
 public:
  HWY_INLINE Differences() : bits_(hn::Zero(D())) {}
  HWY_INLINE void note(Lane<D> a, Lane<D> b) { bits_ = hn::Or(bits_, hn::Xor(a.raw, b.raw)); }
  [[nodiscard]] HWY_INLINE bool none() const {
    const hn::RebindToUnsigned<D> bits;
    return hn::AllTrue(bits, hn::Eq(hn::BitCast(bits, bits_), hn::Zero(bits)));
  }

 private:
  hn::Vec<D> bits_;
};

/// Return mapping of the fibres of one section over a step by their law (Eq. 33-39, E6). `first` is the index in the
/// element of the first fibre of the section. Adds the fibres that yield to `yields`.
///
/// The elastic stress increment of a fibre is stretched + bent * arm, MPa (E5): E times the increments of the membrane
/// strain and of the curvature. `arm` has the distance of each fibre from the axis, in the length with which the
/// curvature was multiplied: h, or the radius of gyration. `weighted_arm` has the same, times the weights through the
/// depth. The curvature is positive where the left side stretches.
template <class Law, class Rule, class D>
HWY_INLINE SectionSums<D> return_map_section(const FibreLaw<Law, D>& law, const Rule& rule,
                                             const typename Rule::Number* arm,
                                             const typename Rule::Number* weighted_arm, Lane<D> stretched, Lane<D> bent,
                                             const Fibres<hn::TFromD<D>>& fibres, std::size_t first,
                                             FibreBits<D>& yields) {
  SectionSums<D> sums;
  Lane<D> reduced[Rule::kDepthRoom];
  Lane<D> within[Rule::kDepthRoom];
  typename FibreLaw<Law, D>::Carried carried[Rule::kDepthRoom];
  Differences<D> differences;
  for (int i = 0; i < rule.depth_points(); ++i) {
    const std::size_t at = (first + static_cast<std::size_t>(i)) * fibres.stride;
    const Lane<D> trial = fma(bent, Lane<D>(arm[i]), stretched) + Lane<D>::load(fibres.stress + at);  // Eq. 34, E6
    const MappedFibre<D> mapped = law.map(trial, fibres, at, carried[i]);
    reduced[i] = mapped.reduced;
    within[i] = mapped.within;
    mapped.stress.store(fibres.stress + at);
    differences.note(reduced[i], within[i]);
    sums.axial = fma(Lane<D>(rule.depth_weight[i]), mapped.stress, sums.axial);
    sums.moment = fma(Lane<D>(weighted_arm[i]), mapped.stress, sums.moment);
  }
  if (differences.none()) {
    return sums;
  }
  FibreBits<D> of_section;
  for (int i = 0; i < rule.depth_points(); ++i) {
    const std::size_t at = (first + static_cast<std::size_t>(i)) * fibres.stride;
    const Lane<D> increment = law.increment(reduced[i], within[i]);
    law.flow(increment, carried[i], fibres, at);
    of_section.add(reduced[i] != within[i], i);
    const Lane<D> stress = law.dissipating(increment, carried[i], fibres, at);
    sums.plastic_work = fma(Lane<D>(rule.depth_weight[i]) * stress, increment, sums.plastic_work);
  }
  yields.add_section(of_section, first);
  return sums;
}

/// Adds the fibres that have yielded in a step to those of the state, if the law keeps no plastic strain.
template <class Law, class D>
HWY_INLINE void keep_yields(const FibreBits<D>& yields, const Fibres<hn::TFromD<D>>& fibres) {
  if constexpr (!Law::kFacts.keeps_plastic_strain) {
    (yields | FibreBits<D>::load(fibres.yielded)).store(fibres.yielded);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
