// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_FIBRE_LAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#undef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#else
#define CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#endif

#include <cstddef>

#include "cellcrush/scene.h"
#include "law/fibres.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Constants of E6 for the material of each lane, MPa.
template <class D>
struct LaneMaterial {
  using Number = hn::TFromD<D>;

  Lane<D> modulus;  ///< E
  Lane<D> yield_stress;
  Lane<D> of_law[kLawParameterCount];  ///< parameters of its law
  Lane<D> isotropic;                   ///< beta H
  Lane<D> kinematic;                   ///< (1 - beta) H
  Lane<D> inverse;                     ///< 1 / (E + H)
  Lane<D> elastic_share;               ///< E / (E + H)

  LaneMaterial() = default;

  /// `load(get)` returns the lanes of get(material).
  template <class Load>
  HWY_INLINE static LaneMaterial from(const Load& load) {
    LaneMaterial loaded;
    loaded.modulus = load([](const Material& material) HWY_ATTR { return material.youngs_modulus; });
    loaded.yield_stress = load([](const Material& material) HWY_ATTR { return material.yield_stress; });
    for (std::size_t i = 0; i < kLawParameterCount; ++i) {
      loaded.of_law[i] = load([i](const Material& material) HWY_ATTR { return material.law.*kLawParameters[i].value; });
    }
    const Lane<D> fraction = loaded.template parameter<&LawParameters::isotropic_fraction>();
    loaded.isotropic = fraction * loaded.hardening();
    loaded.kinematic = (Lane<D>(1) - fraction) * loaded.hardening();
    loaded.set_shares();
    return loaded;
  }

  /// One material in all lanes.
  HWY_INLINE explicit LaneMaterial(const Material& material)
      : LaneMaterial(from([&](const auto& get) HWY_ATTR { return Lane<D>(static_cast<Number>(get(material))); })) {}

  template <double LawParameters::*kValue>
  [[nodiscard]] HWY_INLINE Lane<D> parameter() const {
    constexpr std::size_t kPlace = index_of(kValue);
    return of_law[kPlace];
  }
  [[nodiscard]] HWY_INLINE Lane<D> hardening() const { return parameter<&LawParameters::hardening_modulus_mpa>(); }

  /// The same with a fraction of the modulus (E5c).
  HWY_INLINE LaneMaterial softened(Lane<D> share) const {
    LaneMaterial softer = *this;
    softer.modulus = modulus * share;
    softer.set_shares();
    return softer;
  }

 private:
  HWY_INLINE void set_shares() {
    inverse = Lane<D>(1) / (modulus + hardening());
    elastic_share = modulus * inverse;
  }
};

/// Materials of the walls from `wall` on.
template <class D>
HWY_INLINE LaneMaterial<D> material_of_walls(const Scene& scene, int wall) {
  using Number = hn::TFromD<D>;
  return LaneMaterial<D>::from([&](const auto& get) HWY_ATTR {
    Number values[Lane<D>::kWidth];
    for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
      values[lane] = static_cast<Number>(get(scene.materials[scene.walls.material[wall + lane]]));
    }
    return Lane<D>::load(values);
  });
}

/// A fibre after the elastic trial step: its reduced stress (Eq. 35), the same within the yield surface, and the stress
/// that it returns to. The fibre yields where the first two differ. MPa.
template <class D>
struct MappedFibre {
  Lane<D> reduced;
  Lane<D> within;
  Lane<D> stress;
};

/// The equations of a law (cellcrush/laws.h) for the fibres of the lanes; one file a law specializes it:
///
///   FibreLaw(material, step)        constants of the lanes' materials, and the time step, s
///   map(trial, fibres, at)          return mapping of the elastic trial stress; `at`: place of the fibre in the arrays
///   increment(reduced, within)      plastic strain increment; 0 where the fibre stays elastic
///   flow(increment, fibres, at)     updates the arrays that the law keeps, other than the stress
///   dissipating(increment, fibres, at)  after flow: mean stress over the step by which it dissipates (E10)
///   reduced(fibres, at)             reduced stress before the step
///   tangent(added)                  tangent modulus of a yielding fibre over E, plus `added`
///
/// The stored energy is that of the stress, sigma^2 / 2E, for every law (energy/ledger.h).
template <class Law, class D>
class FibreLaw;

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "law/kinds-inl.h"  // includes all files of law/kinds; CMake writes it

#endif  // CELLCRUSH_LAW_FIBRE_LAW_INL_H_
