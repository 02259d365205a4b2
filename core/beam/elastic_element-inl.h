// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_ELASTIC_ELEMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_ELASTIC_ELEMENT_INL_H_
#undef CELLCRUSH_BEAM_ELASTIC_ELEMENT_INL_H_
#else
#define CELLCRUSH_BEAM_ELASTIC_ELEMENT_INL_H_
#endif

#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// How the ends of an elastic element turn under moments, over what the axial force stretches (E5b), and the inverse of
/// that. Shear adds phi to the turn of the end with the moment and takes it from that of the other (E5i).
template <class D>
class ElasticElement {
  using T = hn::TFromD<D>;

 public:
  /// Does not shear.
  HWY_INLINE ElasticElement()
      : near(T(1.0 / 3.0)), far(T(1.0 / 6.0)), carried(T(0.5)), far_free(T(3)), far_held(T(4)), shear(T(0)) {}

  /// Shears, with phi of each lane.
  HWY_INLINE explicit ElasticElement(Lane<D> phi)
      : near(Lane<D>(T(1.0 / 3.0)) + phi),
        far(Lane<D>(T(1.0 / 6.0)) - phi),
        far_free(Lane<D>(1) / near),
        far_held(near / (Lane<D>(T(1.0 / 12.0)) + phi)),
        shear(phi),
        shears(true) {
    carried = far * far_free;
  }

  Lane<D> near;      ///< turn of an end under its own moment
  Lane<D> far;       ///< and under that of the other end
  Lane<D> carried;   ///< moment at an end that is held, over that of the other end
  Lane<D> far_free;  ///< moment that turns an end while the other is free
  Lane<D> far_held;  ///< and while the other is held
  Lane<D> shear;     ///< phi
  bool shears = false;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_ELASTIC_ELEMENT_INL_H_
