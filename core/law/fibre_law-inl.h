// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_FIBRE_LAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#undef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#else
#define CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#endif

#include <cstddef>

#include "cellcrush/scene.h"
#include "law/laws.h"
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

/// A fibre after the elastic trial step: its reduced stress (Eq. 35), the same within the yield surface, and the stress
/// that it returns to. The fibre yields where the first two differ. MPa.
template <class D>
struct MappedFibre {
  Lane<D> reduced;
  Lane<D> within;
  Lane<D> stress;
};

/// The equations of a law of laws.h for the fibres of the lanes; one file a law specializes it:
///
///   FibreLaw(material, step)        constants of the lanes' materials, and the time step, s
///   map(trial, fibres, at)          return mapping of the elastic trial stress; `at`: place of the fibre in the arrays
///   increment(reduced, within)      plastic strain increment; 0 where the fibre stays elastic
///   flow(increment, fibres, at)     updates the arrays that the law keeps, other than the stress
///   dissipating(stress, increment)  mean stress over the step by which the increment dissipates (E10)
///   reduced(fibres, at)             reduced stress before the step
///   tangent(added)                  tangent modulus of a yielding fibre over E, plus `added`
///
/// The stored energy is that of the stress, sigma^2 / 2E, for every law (energy/ledger.h).
template <class Law, class D>
class FibreLaw;

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "law/mixed_hardening-inl.h"
#include "law/perfectly_plastic-inl.h"

#endif  // CELLCRUSH_LAW_FIBRE_LAW_INL_H_
