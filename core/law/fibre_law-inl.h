// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_FIBRE_LAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#undef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#else
#define CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#endif

#include <algorithm>
#include <cstddef>

#include "cellcrush/scene.h"
#include "law/fibres.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Materials of the walls of the lanes.
template <class D>
class LaneMaterials {
  using Number = hn::TFromD<D>;

 public:
  LaneMaterials() = default;

  /// The same in all lanes.
  HWY_INLINE explicit LaneMaterials(const Material& material) : materials_(&material) {}

  /// Those of the walls from `wall` on.
  HWY_INLINE LaneMaterials(const Scene& scene, int wall)
      : materials_(scene.materials.data()), of_lanes_(&scene.walls.material[wall]) {}

  /// Lanes of get(material).
  template <class Get>
  [[nodiscard]] HWY_INLINE Lane<D> load(const Get& get) const {
    if (of_lanes_ == nullptr) {
      return Lane<D>(static_cast<Number>(get(*materials_)));
    }
    Number values[Lane<D>::kWidth];
    for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
      values[lane] = static_cast<Number>(get(materials_[of_lanes_[lane]]));
    }
    return Lane<D>::load(values);
  }

  /// The greatest size(material).
  template <class Size>
  [[nodiscard]] std::size_t greatest(const Size& size) const {
    std::size_t most = size(of_lanes_ == nullptr ? *materials_ : materials_[of_lanes_[0]]);
    for (std::size_t lane = 1; of_lanes_ != nullptr && lane < Lane<D>::kWidth; ++lane) {
      most = std::max(most, size(materials_[of_lanes_[lane]]));
    }
    return most;
  }

 private:
  const Material* materials_ = nullptr;
  const int* of_lanes_ = nullptr;
};

/// Constants of E6 for the material of each lane, MPa.
template <class D>
struct LaneMaterial {
  Lane<D> modulus;  ///< E
  Lane<D> yield_stress;
  Lane<D> hardening;
  Lane<D> isotropic;      ///< beta H
  Lane<D> kinematic;      ///< (1 - beta) H
  Lane<D> inverse;        ///< 1 / (E + H)
  Lane<D> elastic_share;  ///< E / (E + H)
  LaneMaterials<D> materials;

  LaneMaterial() = default;

  HWY_INLINE explicit LaneMaterial(const LaneMaterials<D>& of) : materials(of) {
    modulus = of.load([](const Material& material) HWY_ATTR { return material.youngs_modulus; });
    yield_stress = of.load([](const Material& material) HWY_ATTR { return material.yield_stress; });
    hardening = parameter<&LawParameters::hardening_modulus_mpa>();
    const Lane<D> fraction = parameter<&LawParameters::isotropic_fraction>();
    isotropic = fraction * hardening;
    kinematic = (Lane<D>(1) - fraction) * hardening;
    set_shares();
  }

  template <double LawParameters::*kValue>
  [[nodiscard]] HWY_INLINE Lane<D> parameter() const {
    return materials.load([](const Material& material) HWY_ATTR { return material.law.*kValue; });
  }

  /// The same with a fraction of the modulus (E5c).
  HWY_INLINE LaneMaterial softened(Lane<D> share) const {
    LaneMaterial softer = *this;
    softer.modulus = modulus * share;
    softer.set_shares();
    return softer;
  }

 private:
  HWY_INLINE void set_shares() {
    inverse = Lane<D>(1) / (modulus + hardening);
    elastic_share = modulus * inverse;
  }
};

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
///   Carried                         what map passes to flow and dissipating
///   map(trial, fibres, at, carried) return mapping of the elastic trial stress; `at`: place of the fibre in the arrays
///   increment(reduced, within)      plastic strain increment; 0 where the fibre stays elastic
///   flow(increment, carried, fibres, at)  updates the arrays that the law keeps, other than the stress
///   dissipating(increment, carried, fibres, at)  after flow: mean stress over the step by which it dissipates (E10)
///   reduced(fibres, at)             reduced stress before the step
///   tangent(added, fibres, at)      tangent modulus of a yielding fibre over E, plus `added`; a law whose fibres have
///                                   the same one ignores the place
///
/// The stored energy is that of the stress, sigma^2 / 2E, for every law (energy/ledger.h).
template <class Law, class D>
class FibreLaw;

/// Of a law that passes nothing on.
struct NothingCarried {};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#ifdef CELLCRUSH_ON_DEVICE  // those that call no function of Highway's for powers and logarithms
#include "law/kinds/mixed_hardening-inl.h"
#include "law/kinds/perfectly_plastic-inl.h"
#else
#include "law/kinds-inl.h"  // includes all files of law/kinds; CMake writes it
#endif

#endif  // CELLCRUSH_LAW_FIBRE_LAW_INL_H_
