#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <vector>

namespace cellcrush {

/// A hardening curve in points, linear between them.
struct HardeningTable {
  enum class Beyond { constant, last_slope, power_law };

  std::vector<double> plastic_strains;  ///< accumulated, ascending from 0. Empty: no table
  std::vector<double> stresses_mpa;     ///< true; they do not fall, and the first is the yield stress
  Beyond beyond = Beyond::last_slope;   ///< how the curve goes on after its last point

  bool operator==(const HardeningTable&) const = default;
};

/// Factor of the yield stress in points: linear over the logarithm of the rate between them, constant outside them.
struct RateTable {
  std::vector<double> rates_per_s;  ///< of the plastic strain, ascending. Empty: no table
  std::vector<double> factors;      ///< they do not fall, and the first is 1

  bool operator==(const RateTable&) const = default;
};

/// Parameters of a material that some laws of its fibres read, beside E and the yield stress.
struct LawParameters {
  double hardening_modulus_mpa = 0.0;              ///< H = E E_T / (E - E_T)
  double isotropic_fraction = 1.0;                 ///< beta of the paper: 1 isotropic, 0 kinematic
  double voce_stress_mpa = 0.0;                    ///< Q of Q (1 - exp(-b ep))
  double voce_exponent = 0.0;                      ///< b
  double ludwik_stress_mpa = 0.0;                  ///< B of B ep^n
  double ludwik_exponent = 0.0;                    ///< n, up to 1
  double cowper_symonds_rate_per_s = 0.0;          ///< D of 1 + (ep' / D)^(1 / q); 0: none
  double cowper_symonds_exponent = 0.0;            ///< q, from 1
  double johnson_cook_coefficient = 0.0;           ///< C of 1 + C ln(ep' / ep0')
  double johnson_cook_reference_rate_per_s = 1.0;  ///< ep0'
  double failure_strain = 0.0;                     ///< plastic strain at which a wall breaks (E6g); 0: never
  HardeningTable hardening_table;
  RateTable rate_table;

  bool operator==(const LawParameters&) const = default;

  /// Whether the yield stress is neither constant nor linear in the plastic strain.
  [[nodiscard]] bool has_curve() const {
    return voce_stress_mpa > 0.0 || ludwik_stress_mpa > 0.0 || !hardening_table.plastic_strains.empty();
  }
  /// Whether walls break.
  [[nodiscard]] bool fails() const { return failure_strain > 0.0; }
  [[nodiscard]] bool hardens() const { return hardening_modulus_mpa > 0.0 || has_curve(); }
  [[nodiscard]] bool depends_on_rate() const {
    return cowper_symonds_rate_per_s > 0.0 || johnson_cook_coefficient > 0.0 || !rate_table.rates_per_s.empty();
  }
};

/// A member of LawParameters. Check, translation and plane strain follow the list of them.
struct LawParameter {
  const char* name;  ///< of the field of a material in case.proto
  double LawParameters::*value;
  int flow_power;     ///< in plane strain it is multiplied by 2 / sqrt 3 as often (E6b): a stress once
  const char* words;  ///< of a material in which it is not the default; {} stands for its value
};

inline constexpr LawParameter kLawParameters[] = {
    {"hardening_modulus_mpa", &LawParameters::hardening_modulus_mpa, 2, "hardening {:.6g} MPa"},
    {"isotropic_fraction", &LawParameters::isotropic_fraction, 0, "isotropic fraction {:.6g}"},
    {"voce_stress_mpa", &LawParameters::voce_stress_mpa, 1, "Voce {:.6g} MPa"},
    {"voce_exponent", &LawParameters::voce_exponent, 1, "Voce exponent {:.6g}"},
    {"ludwik_stress_mpa", &LawParameters::ludwik_stress_mpa, 1, "Ludwik {:.6g} MPa"},
    {"ludwik_exponent", &LawParameters::ludwik_exponent, 0, "Ludwik exponent {:.6g}"},
    {"cowper_symonds_rate_per_s", &LawParameters::cowper_symonds_rate_per_s, -1, "Cowper-Symonds {:.6g} 1/s"},
    {"cowper_symonds_exponent", &LawParameters::cowper_symonds_exponent, 0, "Cowper-Symonds exponent {:.6g}"},
    {"johnson_cook_coefficient", &LawParameters::johnson_cook_coefficient, 0, "Johnson-Cook C {:.6g}"},
    {"johnson_cook_reference_rate_per_s", &LawParameters::johnson_cook_reference_rate_per_s, -1,
     "Johnson-Cook reference rate {:.6g} 1/s"},
    {"failure_strain", &LawParameters::failure_strain, -1, "failure strain {:.6g}"}};

static_assert(sizeof(LawParameters) ==
                  std::size(kLawParameters) * sizeof(double) + sizeof(HardeningTable) + sizeof(RateTable),
              "list every parameter");

/// What the solver asks of a law of the fibres beside its equations, which are in law/fibre_law-inl.h and a file for
/// each law. State, checkpoint, hash and predicted memory have the arrays that the law keeps.
struct LawFacts {
  const char* words;  ///< of the facts of a run
  bool keeps_back_stress = false;
  bool keeps_plastic_strain = false;  ///< without it, a bit for each fibre that has yielded
  bool keeps_tangent = false;         ///< each fibre has a tangent modulus of its own
  bool may_be_single = true;          ///< whether fibres may be in single precision
  /// The same of force-based elements. With hardening, no stress of a yielding fibre
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
      .describes =
          [](const LawParameters& material) {
            return !material.hardens() && !material.depends_on_rate() && !material.fails();
          },
      .even_strain = [](double /*yield_stress*/, const LawParameters& /*material*/) { return 0.0; }};
};

struct MixedHardening {
  static constexpr LawFacts kFacts = {
      .words = "bilinear with mixed hardening; each stores its back stress and accumulated plastic strain",
      .keeps_back_stress = true,
      .keeps_plastic_strain = true,
      .describes = [](const LawParameters& material) { return !material.has_curve() && !material.depends_on_rate(); },
      .even_strain =
          [](double yield_stress, const LawParameters& material) {
            const double hardening = material.hardening_modulus_mpa;
            return hardening > yield_stress ? 1.0 - yield_stress / hardening : 0.0;
          }};
};

/// Plastic strain at which the hardening curve falls below its slope (law/flow_curve.cpp).
double even_strain_of_curve(double yield_stress, const LawParameters& material);

struct FlowStress {
  static constexpr LawFacts kFacts = {
      .words =
          "with a yield stress that follows a curve of the plastic strain, and its rate if the material says how; "
          "each stores its back stress, accumulated plastic strain and tangent modulus",
      .keeps_back_stress = true,
      .keeps_plastic_strain = true,
      .keeps_tangent = true,
      .may_be_single = false,
      .describes = [](const LawParameters&) { return true; },
      .even_strain = even_strain_of_curve};
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
using Laws = LawList<PerfectlyPlastic, MixedHardening, FlowStress>;

}  // namespace cellcrush
