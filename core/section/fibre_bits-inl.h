// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SECTION_FIBRE_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SECTION_FIBRE_BITS_INL_H_
#undef CELLCRUSH_SECTION_FIBRE_BITS_INL_H_
#else
#define CELLCRUSH_SECTION_FIBRE_BITS_INL_H_
#endif

#include <cstddef>

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

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_FIBRE_BITS_INL_H_
