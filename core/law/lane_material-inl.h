// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_LANE_MATERIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_LANE_MATERIAL_INL_H_
#undef CELLCRUSH_LAW_LANE_MATERIAL_INL_H_
#else
#define CELLCRUSH_LAW_LANE_MATERIAL_INL_H_
#endif

#include <cstddef>

#include "cellcrush/scene.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Constants of E6 for the material of each lane, MPa.
template <class D>
struct LaneMaterial {
  using Number = hn::TFromD<D>;

  Lane<D> modulus;  ///< E
  Lane<D> yield_stress;
  Lane<D> hardening;      ///< H
  Lane<D> isotropic;      ///< beta H
  Lane<D> kinematic;      ///< (1 - beta) H
  Lane<D> inverse;        ///< 1 / (E + H)
  Lane<D> elastic_share;  ///< E / (E + H)

  LaneMaterial() = default;
  HWY_INLINE LaneMaterial(Lane<D> youngs_modulus, Lane<D> yield, Lane<D> hardening_modulus, Lane<D> isotropic_fraction)
      : modulus(youngs_modulus),
        yield_stress(yield),
        hardening(hardening_modulus),
        isotropic(isotropic_fraction * hardening_modulus),
        kinematic((Lane<D>(1) - isotropic_fraction) * hardening_modulus),
        inverse(Lane<D>(1) / (modulus + hardening)),
        elastic_share(modulus * inverse) {}

  /// One material in all lanes.
  HWY_INLINE explicit LaneMaterial(const Material& material)
      : LaneMaterial(static_cast<Number>(material.youngs_modulus), static_cast<Number>(material.yield_stress),
                     static_cast<Number>(material.hardening_modulus),
                     static_cast<Number>(material.isotropic_fraction)) {}

  /// The same with a fraction of the modulus (E5c).
  HWY_INLINE LaneMaterial softened(Lane<D> share) const {
    LaneMaterial softer = *this;
    softer.modulus = modulus * share;
    softer.inverse = Lane<D>(1) / (softer.modulus + hardening);
    softer.elastic_share = softer.modulus * softer.inverse;
    return softer;
  }
};

/// Materials of the walls from `wall` on.
template <class D>
HWY_INLINE LaneMaterial<D> material_of_walls(const Scene& scene, int wall) {
  using Number = hn::TFromD<D>;
  const auto load = [&](double Material::*property) HWY_ATTR {
    Number values[Lane<D>::kWidth];
    for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
      values[lane] = static_cast<Number>(scene.materials[scene.walls.material[wall + lane]].*property);
    }
    return Lane<D>::load(values);
  };
  return {load(&Material::youngs_modulus), load(&Material::yield_stress), load(&Material::hardening_modulus),
          load(&Material::isotropic_fraction)};
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_LANE_MATERIAL_INL_H_
