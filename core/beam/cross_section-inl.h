// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_CROSS_SECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
#undef CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
#else
#define CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
#endif

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/thickening.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// The constant data of the cross-sections of elements, for the walls of a block from `lane` on (E5c).
template <class D>
struct CrossSection {
  const Scene& scene;
  int wall;
  Lane<D> thickness;   ///< h_0, mm
  Lane<D> undeformed;  ///< l_0, mm
  Lane<D> depth;       ///< b, mm
  Lane<D> inverse_undeformed;
  bool constant_area;
  bool in_pairs;  ///< elements are solved two by two (E5b)

  HWY_INLINE CrossSection(const Scene& of_scene, const WallBlock& block, int lane)
      : scene(of_scene),
        wall(block.first_wall + lane),
        thickness(Lane<D>::load(&of_scene.walls.thickness[wall])),
        undeformed(Lane<D>::load(&of_scene.walls.undeformed_length[wall])),
        depth(of_scene.depth),
        inverse_undeformed(Lane<D>(1) / undeformed),
        constant_area(of_scene.constant_area),
        in_pairs(of_scene.section.force_based && block.has_pairs()) {}

  /// Area A = V_0 / L, mm^2 (E5c). Plastic flow keeps the volume of a wall that shortens. With constant area, as in the
  /// paper, a wall under its yield force would shorten without end, one element before the others. A wall that is
  /// stretched keeps its area: otherwise it would neck, over the length of an element.
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

  /// Lanes whose elements are squashed: shortened so far that their modulus is reduced and their thickness grows.
  HWY_INLINE LaneMask<D> is_squashed(Lane<D> length) const { return length < Lane<D>(kSquashedStretch) * undeformed; }

  /// Whether any lanes have elements that grow thicker: in plane strain first.
  HWY_INLINE bool grows(Lane<D> length) const {
    constexpr double kFirst = 1.0 / (1.0 + kGrowthLeftOut);
    return !constant_area && any(length < Lane<D>(kFirst) * undeformed);
  }

  /// What half of the thickness has grown by, mm (E5f).
  HWY_INLINE Lane<D> thickening(Lane<D> length) const {
    if (!grows(length)) {
      return 0;
    }
    const Lane<D> shortening = undeformed / length;
    const Lane<D> growth = select(is_in_plane_strain(), shortening, sqrt(shortening)) - Lane<D>(1.0 + kGrowthLeftOut);
    return Lane<D>(0.5) * thickness * min(max(growth, Lane<D>(0)), Lane<D>(kMostThickening - 1.0));
  }

  /// Derivative of the thickening by the length.
  HWY_INLINE Lane<D> slope_of_thickening(Lane<D> length, Lane<D> thickening) const {
    const Lane<D> half = Lane<D>(0.5) * thickness;
    const Lane<D> power = select(is_in_plane_strain(), Lane<D>(1), Lane<D>(0.5));
    const Lane<D> whole = fma(half, Lane<D>(1.0 + kGrowthLeftOut), thickening);
    const LaneMask<D> grows = (thickening > Lane<D>(0)) & (thickening < half * Lane<D>(kMostThickening - 1.0));
    return masked(grows, -power * whole / length);
  }

  /// E_l / E (E5c): with this fraction of its modulus, an element or pair of length l vibrates no faster than at
  /// kSquashedStretch. A / L grows as 1 / l^2 at constant volume; the turn of a node is stiffer by the square of the
  /// thickness. Bending adds the factor P, with the gamma of the rotary inertia, which stays. Such elements yield:
  /// their force is that of the yield stress, and their stored energy is a small part of their plastic work.
  HWY_INLINE Lane<D> modulus_share(Lane<D> length, Lane<D> inverse_length, Lane<D> thickening) const {
    const Lane<D> one = 1;
    const Lane<D> ratio = length * inverse_of_bound();
    Lane<D> share = (constant_area ? one : ratio * ratio) * bending_at_bound() / bending_of(inverse_length).factor;
    if (grows(length)) {
      const Lane<D> over_growth = thickness / (thickness + thickening + thickening);
      share = share * over_growth * over_growth;
    }
    return select(is_squashed(length), share, one);
  }

  /// -1/2 L (dE_l/dl) / E_l^2, 1/MPa (E5g); 0 of elements that are not squashed. With the factor P, its slope P' =
  /// -dP/dl l / 2 and the growth g = h / h_0 it is -L g^2 (0.95 l_0 / l)^2 [(P + P') / l - P g' / g] over E and the
  /// factor at 0.95 l_0.
  HWY_INLINE Lane<D> fall_of_modulus(Lane<D> length, Lane<D> inverse_length, Lane<D> thickening,
                                     Lane<D> slope_of_thickening) const {
    const Lane<D> one = 1;
    const Bending bending = bending_of(inverse_length);
    Lane<D> fall = (constant_area ? bending.slope : bending.factor + bending.slope) * inverse_length;
    if (grows(length)) {
      const Lane<D> inverse_half = Lane<D>(2) / thickness;
      const Lane<D> growth = fma(thickening, inverse_half, one);
      fall = growth * fms(growth, fall, bending.factor * slope_of_thickening * inverse_half);
    }
    const Lane<D> over_ratio = constant_area ? one : Lane<D>(kSquashedStretch) * undeformed * inverse_length;
    const Lane<D> strained = constant_area ? undeformed : length;
    return masked(is_squashed(length), -(strained * over_ratio * over_ratio * fall) / (modulus() * bending_at_bound()));
  }

  /// E of the walls, MPa.
  HWY_INLINE Lane<D> modulus() const {
    double moduli[Lane<D>::kWidth];
    for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
      moduli[lane] = material_of(lane).youngs_modulus;
    }
    return Lane<D>::load(moduli);
  }

 private:
  /// By what bending multiplies the square of the greatest frequency, with s = q h_0^2 / l^2: 1 + s / 3 for an element
  /// (E11b), (1 + s + sqrt(1 + s + s^2)) / 2 for a pair (E11c).
  struct Bending {
    Lane<D> factor;  ///< P
    Lane<D> slope;   ///< s dP/ds = -dP/dl l / 2
  };
  HWY_INLINE Bending bending_of(Lane<D> inverse_length) const {
    const Lane<D> one = 1;
    const Lane<D> half = 0.5;
    const Lane<D> slenderness = thickness * inverse_length;
    const Lane<D> s = Lane<D>(scene.mass_scaling.rotary) * slenderness * slenderness;
    if (!in_pairs) {
      const Lane<D> third = s * Lane<D>(1.0 / 3.0);
      return {one + third, third};
    }
    const Lane<D> root = sqrt(fma(s, s, one + s));
    return {half * (one + s + root), half * s * fma(half, (one + s + s) / root, one)};
  }
  HWY_INLINE Lane<D> inverse_of_bound() const { return Lane<D>(1.0 / kSquashedStretch) * inverse_undeformed; }
  HWY_INLINE Lane<D> bending_at_bound() const { return bending_of(inverse_of_bound()).factor; }

  HWY_INLINE const Material& material_of(std::size_t lane) const {
    return scene.materials[scene.materials.size() == 1 ? 0 : scene.walls.material[wall + static_cast<int>(lane)]];
  }

  HWY_INLINE LaneMask<D> is_in_plane_strain() const {
    double held[Lane<D>::kWidth];
    for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
      held[lane] = material_of(lane).plane_strain ? 1.0 : 0.0;
    }
    return Lane<D>::load(held) > 0.0;
  }
};

/// Thickness of squashed elements in the arrays of the state (E5f), and what follows from it.
template <class D>
class GrownWalls {
  using Real = Lane<D>;

 public:
  explicit GrownWalls(State& state)
      : length_(state.length.data()),
        inverse_length_(state.inverse_length.data()),
        thickening_(state.thickening.data()),
        slope_(state.thickening_slope.data()),
        radius_growth_(state.radius_growth.data()) {}

  /// Greatest growth of half of an element's thickness by grow(), mm; not below 0.
  [[nodiscard]] HWY_INLINE double step() const { return greatest_of_lanes(step_); }

  /// What half of the thickness has grown by, mm.
  struct Growth {
    Real before;
    Real now;
  };

  /// Updates the thickness of elements that now have this length. REQUIRES: section.grows() now or before.
  HWY_INLINE Growth grow(const CrossSection<D>& section, std::ptrdiff_t element, Real length) {
    const Real before = Real::load(thickening_ + element);
    const Real now = section.thickening(length);
    now.store(thickening_ + element);
    section.slope_of_thickening(length, now).store(slope_ + element);
    step_ = max(step_, now - before);
    return {before, now};
  }

  /// Updates the radius of balls between two elements.
  HWY_INLINE void grow_balls(std::ptrdiff_t particle, std::ptrdiff_t element, std::ptrdiff_t next) const {
    (Real(0.5) * (Real::load(thickening_ + element) + Real::load(thickening_ + next))).store(radius_growth_ + particle);
  }

  /// Area of elements times their thickness over that before loading, mm^2.
  HWY_INLINE Real moment_area(const CrossSection<D>& section, std::ptrdiff_t element) const {
    const Real area = section.area(Real::load(inverse_length_ + element));
    if (section.constant_area) {
      return area;
    }
    const Real thickening = Real::load(thickening_ + element);
    return area * (Real(1) + (thickening + thickening) / section.thickness);
  }

  /// What the axial stress is more where the modulus falls with the length (E5g), MPa: dU/dl over A, with the stored
  /// energy U of n = `axial` and of the moments over A h, `left` and `right`. U at given stresses goes as 1 / E_l.
  HWY_INLINE Real stress_of_modulus(const CrossSection<D>& section, std::ptrdiff_t element, Real axial, Real left,
                                    Real right) const {
    const Real length = Real::load(length_ + element);
    if (none(section.is_squashed(length))) {
      return 0;
    }
    const Real thickening = section.constant_area ? Real(0) : Real::load(thickening_ + element);
    const Real slope = section.constant_area ? Real(0) : Real::load(slope_ + element);
    const Real bending = fma(left, left, fma(left, right, right * right));  // 4 of it are those of m over A gamma
    return fma(axial, axial, Real(4) * bending) *
           section.fall_of_modulus(length, Real::load(inverse_length_ + element), thickening, slope);
  }

 private:
  const double* const length_;
  const double* const inverse_length_;
  double* const thickening_;  // null at constant area, like those below
  double* const slope_;
  double* const radius_growth_;
  Real step_ = 0;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
