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

/// Least modulus over the yield stress by which the elastic strain of a squashed element is taken, and least such
/// strain (E5c). L follows from the modulus, and the modulus from L: with less, one would run away from the other.
inline constexpr double kLeastModulusOfStrain = 20.0;
inline constexpr double kLeastElasticStrain = -0.5;

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

  /// l_0 / L, at least 1 (E5c): L is the length without elastic strain. A wall that is stretched has L = l_0, and so
  /// keeps its area: otherwise it would neck, over the length of an element.
  HWY_INLINE Lane<D> shortening(Lane<D> inverse_length, Lane<D> elastic_strain) const {
    return max(undeformed * inverse_length * (Lane<D>(1) + elastic_strain), Lane<D>(1));
  }

  /// Elastic strain of squashed elements under the axial stress (E5c). Their modulus is no real one: in compression, at
  /// the yield stress before hardening, they have the strain of the real modulus.
  HWY_INLINE Lane<D> elastic_strain(Lane<D> axial, Lane<D> inverse_squashed, Lane<D> inverse_modulus) const {
    const Lane<D> yield = yield_stress();
    const Lane<D> most = max(Lane<D>(1.0 / kLeastModulusOfStrain) / yield, inverse_modulus);
    const Lane<D> of_modulus = min(inverse_squashed, most);
    return max(fma(axial, of_modulus, yield * (of_modulus - inverse_modulus)), Lane<D>(kLeastElasticStrain));
  }

  /// Area A = V_0 / L, mm^2 (E5c). Plastic flow keeps the volume of a wall that shortens. With constant area, as in the
  /// paper, a wall under its yield force would shorten without end, one element before the others.
  HWY_INLINE Lane<D> area(Lane<D> shortening) const {
    const Lane<D> area = depth * thickness;
    return constant_area ? area : area * shortening;
  }

  /// 1 / L over a step, 1/mm, from that at its start: the strains over L do the work of the forces on V_0 (E5).
  HWY_INLINE Lane<D> inverse_strained(Lane<D> shortening) const {
    return constant_area ? inverse_undeformed : shortening * inverse_undeformed;
  }

  /// V_0, mm^3, over which the stress does work.
  HWY_INLINE Lane<D> volume() const { return depth * thickness * undeformed; }

  /// Lanes whose elements are squashed: shortened so far that their modulus is reduced and their thickness may grow.
  HWY_INLINE LaneMask<D> is_squashed(Lane<D> shortening) const { return shortening > Lane<D>(1.0 / kSquashedStretch); }

  /// Whether any lanes have elements that grow thicker: in plane strain first.
  HWY_INLINE bool grows(Lane<D> shortening) const {
    return !constant_area && any(shortening > Lane<D>(1.0 + kGrowthLeftOut));
  }

  /// What half of the thickness has grown by, mm (E5f): in bending with l_0 / L, in contact with l_0 / l.
  HWY_INLINE Lane<D> thickening(Lane<D> shortening) const {
    if (!grows(shortening)) {
      return 0;
    }
    const Lane<D> growth = select(is_in_plane_strain(), shortening, sqrt(shortening)) - Lane<D>(1.0 + kGrowthLeftOut);
    return Lane<D>(0.5) * thickness * min(max(growth, Lane<D>(0)), Lane<D>(kMostThickening - 1.0));
  }

  /// Derivative of the thickening by the length.
  HWY_INLINE Lane<D> slope_of_thickening(Lane<D> shortening, Lane<D> thickening) const {
    const Lane<D> half = Lane<D>(0.5) * thickness;
    const Lane<D> power = select(is_in_plane_strain(), Lane<D>(1), Lane<D>(0.5));
    const Lane<D> whole = fma(half, Lane<D>(1.0 + kGrowthLeftOut), thickening);
    const LaneMask<D> grows = (thickening > Lane<D>(0)) & (thickening < half * Lane<D>(kMostThickening - 1.0));
    return masked(grows, -power * whole * shortening * inverse_undeformed);
  }

  /// E_l / E (E5c): with this fraction of its modulus, an element or pair of length L vibrates no faster than at
  /// kSquashedStretch. A / L grows as 1 / L^2 at constant volume; the turn of a node is stiffer by the square of the
  /// thickness. Bending adds the factor P, with the gamma of the rotary inertia, which stays. Such elements yield:
  /// their force is that of the yield stress, and their stored energy is a small part of their plastic work.
  HWY_INLINE Lane<D> modulus_share(Lane<D> shortening, Lane<D> thickening) const {
    return select(is_squashed(shortening), stiffness_at_bound() / stiffness(shortening, thickening), Lane<D>(1));
  }

  /// Square of the greatest frequency of elements with the modulus E, but for a factor of the element; and that at
  /// kSquashedStretch.
  HWY_INLINE Lane<D> stiffness(Lane<D> shortening, Lane<D> thickening) const {
    const Lane<D> stiffer = constant_area ? thickness : shortening * (thickness + thickening + thickening);
    return bending_of(shortening) * (stiffer * stiffer);
  }
  HWY_INLINE Lane<D> stiffness_at_bound() const { return stiffness(Lane<D>(1.0 / kSquashedStretch), Lane<D>(0)); }

  /// E of the walls, MPa.
  HWY_INLINE Lane<D> modulus() const { return of_materials<&Material::youngs_modulus>(); }

 private:
  /// P, by which bending multiplies the square of the greatest frequency, with s = q h_0^2 / L^2: 1 + s / 3 for an
  /// element (E11b), (1 + s + sqrt(1 + s + s^2)) / 2 for a pair (E11c).
  HWY_INLINE Lane<D> bending_of(Lane<D> shortening) const {
    const Lane<D> one = 1;
    const Lane<D> slenderness = thickness * shortening * inverse_undeformed;
    const Lane<D> s = Lane<D>(scene.mass_scaling.rotary) * slenderness * slenderness;
    if (!in_pairs) {
      return fma(s, 1.0 / 3.0, one);
    }
    return Lane<D>(0.5) * (one + s + sqrt(fma(s, s, one + s)));
  }

  HWY_INLINE Lane<D> yield_stress() const { return of_materials<&Material::yield_stress>(); }

  template <double Material::*kValue>
  HWY_INLINE Lane<D> of_materials() const {
    if (scene.materials.size() == 1) {
      return scene.materials.front().*kValue;
    }
    double values[Lane<D>::kWidth];
    for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
      values[lane] = material_of(lane).*kValue;
    }
    return Lane<D>::load(values);
  }

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

/// Thickness that squashed elements have in contact, in the arrays of the state (E5f).
template <class D>
class GrownWalls {
  using Real = Lane<D>;

 public:
  HWY_INLINE explicit GrownWalls(State& state)
      : thickening_(state.thickening.data()),
        slope_(state.thickening_slope.data()),
        radius_growth_(state.radius_growth.data()) {}

  /// Greatest growth of half of an element's thickness by grow(), mm; not below 0.
  [[nodiscard]] HWY_INLINE double step() const { return greatest_of_lanes(step_); }

  /// What half of the thickness has grown by, mm.
  [[nodiscard]] HWY_INLINE Real thickening(std::ptrdiff_t element) const { return Real::load(thickening_ + element); }

  /// Updates the thickness of elements of the length l_0 / `compression`. REQUIRES: not at constant area.
  HWY_INLINE void grow(const CrossSection<D>& section, std::ptrdiff_t element, Real compression) {
    const Real before = thickening(element);
    const Real now = section.thickening(compression);
    now.store(thickening_ + element);
    section.slope_of_thickening(compression, now).store(slope_ + element);
    step_ = max(step_, now - before);
  }

  /// Updates the radius of balls between two elements.
  HWY_INLINE void grow_balls(std::ptrdiff_t particle, std::ptrdiff_t element, std::ptrdiff_t next) const {
    (Real(0.5) * (thickening(element) + thickening(next))).store(radius_growth_ + particle);
  }

 private:
  double* const thickening_;  // null at constant area, like those below
  double* const slope_;
  double* const radius_growth_;
  Real step_ = 0;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_CROSS_SECTION_INL_H_
