// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_CROSS_SECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
#undef CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
#else
#define CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
#endif

#include "cellcrush/scene.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// l / l_0 below which the modulus is reduced (E5c).
inline constexpr double kModulusCapStretch = 0.95;

/// The constant data of the cross-sections of elements, for the walls from `wall` on (E5c).
template <class D>
struct CrossSection {
  Lane<D> thickness;   ///< h, mm
  Lane<D> undeformed;  ///< l_0, mm
  Lane<D> depth;       ///< b, mm
  Lane<D> inverse_undeformed;
  bool constant_area;

  HWY_INLINE CrossSection(const Scene& scene, int wall)
      : thickness(Lane<D>::load(&scene.walls.thickness[wall])),
        undeformed(Lane<D>::load(&scene.walls.undeformed_length[wall])),
        depth(scene.depth),
        inverse_undeformed(Lane<D>(1) / undeformed),
        constant_area(scene.constant_area) {}

  /// Area A = V_0 / L, mm^2 (E5c). Plastic flow keeps the volume of a wall that shortens, with the thickness in the
  /// plane kept. With constant area, as in the paper, a wall under its yield force would shorten without end, one
  /// element before the others. A wall that is stretched keeps its area: otherwise it would neck, over the length of an
  /// element.
  HWY_INLINE Lane<D> area(Lane<D> inverse_length) const {
    const Lane<D> area = depth * thickness;
    return constant_area ? area : area * max(undeformed * inverse_length, Lane<D>(1));
  }

  /// 1 / L over a step, 1/mm, from 1 / l_m: the strains over L do the work of the forces on V_0 (E5).
  HWY_INLINE Lane<D> inverse_strained(Lane<D> inverse_mean) const {
    return constant_area ? inverse_undeformed : max(inverse_mean, inverse_undeformed);
  }

  /// V_0, mm^3, over which the stress does work.
  HWY_INLINE Lane<D> volume() const { return depth * thickness * undeformed; }

  /// Lanes whose elements are compressed so far that their modulus is reduced.
  HWY_INLINE LaneMask<D> is_compressed(Lane<D> length) const {
    return length < Lane<D>(kModulusCapStretch) * undeformed;
  }

  /// E_l / E (E5c): with this fraction of its modulus, an element of length l vibrates no faster than at
  /// kModulusCapStretch. A / L and I / L grow as 1 / l^2 at constant volume. The shear due to bending grows by
  /// 1 + 4 gamma^2 / l^2 (E11). Such an element yields: its force is that of the yield stress, and its stored energy is
  /// a small part of its plastic work.
  HWY_INLINE Lane<D> modulus_share(Lane<D> length) const {
    const Lane<D> one = 1;
    const Lane<D> bound = Lane<D>(kModulusCapStretch) * undeformed;
    const Lane<D> four_gyration_squared = thickness * thickness * Lane<D>(1.0 / 3.0);
    const Lane<D> ratio = length / bound;
    const Lane<D> at_bound = one + four_gyration_squared / (bound * bound);
    const Lane<D> now = one + four_gyration_squared / (length * length);
    const Lane<D> share = (constant_area ? one : ratio * ratio) * at_bound / now;
    return select(is_compressed(length), share, one);
  }
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
