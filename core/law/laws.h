#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// History of the fibres of an element: every `stride`-th value of the arrays in the state. MPa; plastic_strain is the
/// accumulated (effective) one, dimensionless. Null: the law does not keep it. Without plastic strain there is
/// one bit for each fibre that has yielded. T: double or float.
template <class T>
struct Fibres {
  T* __restrict stress;
  T* __restrict back_stress;
  T* __restrict plastic_strain;
  typename FibreHistory<T>::Bits* __restrict yielded;
  std::size_t stride = 1;
};

/// What the solver asks of a law of the fibres beside its equations, which are in law/fibre_law-inl.h and a file for
/// each law. State, checkpoint, hash and predicted memory have the arrays that the law keeps.
struct LawFacts {
  const char* words;  ///< of the facts of a run
  bool keeps_back_stress = false;
  bool keeps_plastic_strain = false;  ///< without it, a bit for each fibre that has yielded
  /// Whether fibres of force-based elements may be in single precision. With hardening, no stress of a yielding fibre
  /// is exact; a force-based section that yields would turn the rounding of a slow crush into plastic work: 1.3 % of it
  /// in Example 1 at 1 m/s.
  bool may_be_single_in_force_based = false;
  bool (*describes)(const Material& material);
};

struct PerfectlyPlastic {
  static constexpr LawFacts kFacts = {
      .words = "perfectly plastic; each stores only its stress",
      .may_be_single_in_force_based = true,
      .describes = [](const Material& material) { return !(material.hardening_modulus > 0.0); }};
};

struct MixedHardening {
  static constexpr LawFacts kFacts = {
      .words = "bilinear with mixed hardening; each stores its back stress and accumulated plastic strain",
      .keeps_back_stress = true,
      .keeps_plastic_strain = true,
      .describes = [](const Material&) { return true; }};
};

template <class... Each>
struct LawList {
  static constexpr std::array<LawFacts, sizeof...(Each)> kFacts = {Each::kFacts...};

  /// Calls visit(law) with the law of an index.
  template <class Visit>
  static void visit(std::size_t law, const Visit& visit) {
    std::size_t index = 0;
    ((index++ == law ? visit(Each()) : void()), ...);
  }
};

/// All laws. A scene has the first one that describes its materials.
using Laws = LawList<PerfectlyPlastic, MixedHardening>;

/// Index of the law of a scene of some materials.
inline std::size_t law_of(std::span<const Material> materials) {
  const auto describes_all = [&](const LawFacts& law) { return std::ranges::all_of(materials, law.describes); };
  return static_cast<std::size_t>(std::ranges::find_if(Laws::kFacts, describes_all) - Laws::kFacts.begin());
}

inline const LawFacts& law_facts_of(const Scene& scene) { return Laws::kFacts[scene.law]; }

}  // namespace cellcrush
