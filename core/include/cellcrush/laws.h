#pragma once

#include <array>
#include <cstddef>
#include <iterator>

namespace cellcrush {

/// Parameters of a material that some laws of its fibres read, beside E and the yield stress.
struct LawParameters {
  double hardening_modulus_mpa = 0.0;  ///< H = E E_T / (E - E_T)
  double isotropic_fraction = 1.0;     ///< beta of the paper: 1 isotropic, 0 kinematic

  bool operator==(const LawParameters&) const = default;
};

/// A member of LawParameters. Check, translation, plane strain and the lanes of the kernels follow the list of them.
struct LawParameter {
  const char* name;  ///< of the field of a material in case.proto
  double LawParameters::*value;
  int flow_power;     ///< in plane strain it is multiplied by 2 / sqrt 3 as often (E6b): a stress once
  const char* words;  ///< of a material in which it is not the default; {} stands for its value
};

inline constexpr LawParameter kLawParameters[] = {
    {"hardening_modulus_mpa", &LawParameters::hardening_modulus_mpa, 2, "hardening {:.6g} MPa"},
    {"isotropic_fraction", &LawParameters::isotropic_fraction, 0, "isotropic fraction {:.6g}"}};

inline constexpr std::size_t kLawParameterCount = std::size(kLawParameters);
static_assert(sizeof(LawParameters) == kLawParameterCount * sizeof(double), "list every parameter");

/// Place of a parameter in the list.
constexpr std::size_t index_of(double LawParameters::*value) {
  std::size_t i = 0;
  while (kLawParameters[i].value != value) {
    ++i;
  }
  return i;
}

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
  bool (*describes)(const LawParameters& material);
  /// Plastic strain up to which a wall stretches evenly: until its true stress is its hardening (Considere).
  double (*even_strain)(double yield_stress, const LawParameters& material);
};

struct PerfectlyPlastic {
  static constexpr LawFacts kFacts = {
      .words = "perfectly plastic; each stores only its stress",
      .may_be_single_in_force_based = true,
      .describes = [](const LawParameters& material) { return !(material.hardening_modulus_mpa > 0.0); },
      .even_strain = [](double /*yield_stress*/, const LawParameters& /*material*/) { return 0.0; }};
};

struct MixedHardening {
  static constexpr LawFacts kFacts = {
      .words = "bilinear with mixed hardening; each stores its back stress and accumulated plastic strain",
      .keeps_back_stress = true,
      .keeps_plastic_strain = true,
      .describes = [](const LawParameters&) { return true; },
      .even_strain =
          [](double yield_stress, const LawParameters& material) {
            const double hardening = material.hardening_modulus_mpa;
            return hardening > yield_stress ? 1.0 - yield_stress / hardening : 0.0;
          }};
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

/// All laws. A scene has the first one that describes its materials; the last one describes all.
using Laws = LawList<PerfectlyPlastic, MixedHardening>;

}  // namespace cellcrush
