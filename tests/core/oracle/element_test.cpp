#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "cellcrush/simd.h"
#include "cellcrush/state.h"
#include "core/oracle/lattice_of_scene.h"
#include "core/oracle/random_motions.h"
#include "core/reference/reference_element.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using Formulation = SectionSpec::Formulation;
using DepthRule = SectionSpec::DepthRule;
using AreaRule = SectionSpec::AreaRule;
using Precision = NumericsSpec::FibrePrecision;

/// A rule of elements.
struct Rule {
  const char* name;
  Formulation formulation;
  DepthRule depth_rule;
  int sections;
  int points;
  double shear_factor = 0.0;  // 0: without shear

  friend void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }
};

constexpr Rule kRules[] = {
    {"Paper", Formulation::displacement_based, DepthRule::lobatto, 2, 6},
    {"Default", Formulation::force_based, DepthRule::full_moment, 4, 6},
    {"DisplacementBased2x4", Formulation::displacement_based, DepthRule::lobatto, 2, 4},
    {"DisplacementBased2x6FullMoment", Formulation::displacement_based, DepthRule::full_moment, 2, 6},
    {"DisplacementBased3x4", Formulation::displacement_based, DepthRule::full_moment, 3, 4},
    {"DisplacementBased5x8", Formulation::displacement_based, DepthRule::lobatto, 5, 8},
    {"ForceBased3x4", Formulation::force_based, DepthRule::full_moment, 3, 4},
    {"ForceBased4x6Lobatto", Formulation::force_based, DepthRule::lobatto, 4, 6},
    {"ForceBased5x8", Formulation::force_based, DepthRule::lobatto, 5, 8},
    {"ForceBased5x10", Formulation::force_based, DepthRule::lobatto, 5, 10},
    {"DefaultShearing", Formulation::force_based, DepthRule::full_moment, 4, 6, 0.1},
    {"ForceBased5x8Shearing", Formulation::force_based, DepthRule::lobatto, 5, 8, 0.1},
};

struct Hardening {
  const char* name;
  LawParameters law;

  /// Whether there is more than a linear term: then the elements of the oracle are displacement-based, as it has no
  /// tangents, and fibres are in double precision.
  [[nodiscard]] bool has_curves() const { return law.has_curve() || law.depends_on_rate(); }
};

LawParameters linear(double modulus_mpa, double isotropic_fraction) {
  LawParameters law;
  law.hardening_modulus_mpa = modulus_mpa;
  law.isotropic_fraction = isotropic_fraction;
  return law;
}

/// Voce and a linear term, at rates of Cowper and Symonds; and Ludwik's, at those of Johnson and Cook.
LawParameters voce_and_symonds() {
  LawParameters law = linear(500.0, 0.4);
  law.voce_stress_mpa = 60.0;
  law.voce_exponent = 12.0;
  law.cowper_symonds_rate_per_s = 6500.0;
  law.cowper_symonds_exponent = 4.0;
  return law;
}
LawParameters ludwik_and_johnson() {
  LawParameters law = linear(0.0, 0.7);
  law.ludwik_stress_mpa = 110.0;
  law.ludwik_exponent = 0.4;
  law.johnson_cook_coefficient = 0.02;
  return law;
}

const Hardening kHardenings[] = {{"none", linear(0.0, 1.0)},
                                 {"isotropic", linear(700.0, 1.0)},
                                 {"kinematic", linear(700.0, 0.0)},
                                 {"mixed", linear(700.0, 0.4)},
                                 {"Voce and Cowper-Symonds", voce_and_symonds()},
                                 {"Ludwik and Johnson-Cook", ludwik_and_johnson()}};

/// Beams side by side, of one element and of two: of each a full block of walls, and some that remain.
constexpr int kShortBeams = 19;
constexpr int kPairs = 19;
/// Beams of more elements, by their number.
constexpr int kLongBeams[] = {3, 4, 6};
constexpr int kBeams = kShortBeams + kPairs + static_cast<int>(std::size(kLongBeams));
constexpr int kSteps = 240;

int elements_of_beam(int beam) {
  if (beam < kShortBeams) {
    return 1;
  }
  return beam < kShortBeams + kPairs ? 2 : kLongBeams[beam - kShortBeams - kPairs];
}

/// Beams that do not touch, of three thicknesses and two materials.
SceneSpec spec_of(const Rule& rule, const Hardening& hardening, AreaRule area, Precision precision) {
  FrameLattice frame;
  for (int w = 0; w < kBeams; ++w) {
    const int elements = elements_of_beam(w);
    const double length = (3.0 + 0.1 * (w % kShortBeams)) * elements;
    frame.nodes.push_back({50.0 * w, 0.0, 0.0, 0.0});
    frame.nodes.push_back({50.0 * w + length * std::cos(0.7 * w), length * std::sin(0.7 * w), 0.0, 0.0});
    frame.beams.push_back(scenes::beam(2 * w, 2 * w + 1, 0.2 + 0.15 * (w % 3), elements));
  }
  SceneSpec spec = scenes::plastic_frame(frame, 69000.0, 76.0, scenes::kDensity);
  spec.depth_mm = 2.5;
  static_cast<LawParameters&>(spec.material) = hardening.law;
  MaterialSpec other = spec.material;
  other.youngs_modulus_mpa = 41000.0;
  other.yield_stress_mpa = 120.0;
  auto& beams = std::get<FrameWalls>(spec.lattice).beams;
  for (int w = 0; w < kBeams; w += 4) {
    beams[w].material = other;
  }
  spec.section = {rule.formulation, rule.depth_rule, area, rule.sections, rule.points};
  spec.section.shear_deformation = rule.shear_factor > 0.0;
  if (spec.section.shear_deformation) spec.section.shear_factor = rule.shear_factor;
  spec.numerics.fibre_precision = precision;
  return spec;
}

/// Largest differences between the running solver and the oracle.
struct ElementDifferences {
  double force = 0.0;           // over sigma_y A
  double moment = 0.0;          // over sigma_y A h
  double stress = 0.0;          // and back stress, over sigma_y
  double plastic_strain = 0.0;  // over sigma_y / E
  double borne = 0.0;           // n and m of the sections, over sigma_y
  double plastic_work = 0.0;    // of the work so far
  double elastic = 0.0;         // of the energy stored
  int parted = 0;               // steps of walls in which only one of the two took a fibre as yielding; left out

  double worked = 0.0;    // N mm, by the oracle
  double shortest = 1.0;  // l / l_0
};

void note_largest(double& greatest, double difference) { greatest = std::max(greatest, std::abs(difference)); }

/// Compares the forces on the nodes of a wall with those of the oracle's elements.
void note_forces(const Scene& scene, const State& state, const std::vector<int>& wall,
                 const std::vector<reference::ElementForces>& forces, ElementDifferences& most) {
  const std::vector<int> nodes = nodes_of(scene, wall);
  std::vector<Vector2> on_nodes(nodes.size(), Vector2::Zero());
  std::vector<double> moments(nodes.size(), 0.0);
  for (std::size_t k = 0; k < wall.size(); ++k) {
    on_nodes[k] += forces[k].on_end;
    on_nodes[k + 1] -= forces[k].on_end;
    moments[k] -= forces[k].moment_on_start;
    moments[k + 1] -= forces[k].moment_on_end;
  }
  const reference::ElementData data = element_data_of(scene, wall.front());
  const double yield_force = data.material.yield_stress * data.depth * data.thickness;
  const double yield_moment = yield_force * data.thickness;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    note_largest(most.force, (state.internal_force[nodes[k]] - on_nodes[k]).norm() / yield_force);
    note_largest(most.moment, (state.internal_moment[nodes[k]] - moments[k]) / yield_moment);
  }
}

void note_histories(const reference::ElementHistory& solver, const reference::ElementHistory& oracle,
                    const reference::ElementData& data, bool has_hardening, ElementDifferences& most) {
  const double yield = data.material.yield_stress;
  for (std::size_t i = 0; i < oracle.borne.size(); ++i) {
    note_largest(most.borne, (solver.borne[i] - oracle.borne[i]).norm() / yield);  // 0 if displacement-based
  }
  for (std::size_t f = 0; f < oracle.fibres.size(); ++f) {
    note_largest(most.stress, (solver.fibres[f].stress - oracle.fibres[f].stress) / yield);
    if (has_hardening) {
      note_largest(most.stress, (solver.fibres[f].back_stress - oracle.fibres[f].back_stress) / yield);
      note_largest(most.plastic_strain,
                   (solver.fibres[f].plastic_strain - oracle.fibres[f].plastic_strain) * data.material.modulus / yield);
    }
  }
}

/// Whether both remember the same fibres as yielding.
bool yield_alike(const reference::ElementHistory& solver, const reference::ElementHistory& oracle) {
  return solver.yields == oracle.yields && solver.yielded_before == oracle.yielded_before;
}

enum class Start { of_the_step, of_the_run };

/// The oracle's elements of a scene.
class OracleElements {
 public:
  OracleElements(const Scene& scene, const State& state) : scene_(scene), rule_(element_rule_of(scene)) {
    adopt(state);
  }

  /// Goes on from the solver's histories.
  void adopt(const State& state) {
    histories.clear();
    for (std::size_t e = 0; e < scene_.element_count(); ++e) {
      histories.push_back(element_history_of(scene_, state, e));
    }
  }

  /// The step that has brought the solver's particles where they are.
  std::vector<reference::ElementForces> advance(const State& state, const std::vector<int>& wall) {
    std::vector<reference::ElementForces> forces;
    for (const std::vector<int>& unit : units_of(rule_, wall)) {
      std::vector<reference::MovedElement> moved;
      for (const int e : unit) {
        moved.push_back({element_data_of(scene_, e), ends_of(state, scene_.elements[e]), &histories[e]});
      }
      const std::vector<reference::ElementForces> of_unit = advance_unit(rule_, moved);
      forces.insert(forces.end(), of_unit.begin(), of_unit.end());
    }
    return forces;
  }

  /// Elastic energy, N mm.
  [[nodiscard]] double stored() const {
    double sum = 0.0;
    for (std::size_t e = 0; e < histories.size(); ++e) {
      sum += reference::elastic_energy(rule_, element_data_of(scene_, e), histories[e]);
    }
    return sum;
  }

  std::vector<reference::ElementHistory> histories;

 private:
  [[nodiscard]] reference::ElementEnds ends_of(const State& state, const Element& element) const {
    const double dt = scene_.schedule.time_step;
    return {state.position[element.start], state.position[element.end], dt * state.spin[element.start],
            dt * state.spin[element.end]};
  }

  const Scene& scene_;
  reference::ElementRule rule_;
};

/// Compares the elements of a wall after a step.
void compare_wall(const Scene& scene, const State& state, const std::vector<int>& wall,
                  const std::vector<reference::ElementForces>& forces,
                  const std::vector<reference::ElementHistory>& oracle, ElementDifferences& most) {
  std::vector<reference::ElementHistory> solver;
  bool alike = true;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    solver.push_back(element_history_of(scene, state, wall[k]));
    alike = alike && (!scene.section.force_based || yield_alike(solver[k], oracle[wall[k]]));
    most.worked += forces[k].plastic_work;
    most.shortest = std::min(most.shortest, solver[k].length / element_data_of(scene, wall[k]).undeformed_length);
  }
  if (!alike) {
    ++most.parted;
    return;
  }
  note_forces(scene, state, wall, forces, most);
  for (std::size_t k = 0; k < wall.size(); ++k) {
    note_histories(solver[k], oracle[wall[k]], element_data_of(scene, wall[k]),
                   Laws::kFacts[scene.law].keeps_plastic_strain, most);
  }
}

/// Moves the solver and takes the same motion through the oracle, whose elements have the solver's histories at the
/// start of every step, or only of the run.
ElementDifferences compare_elements(const Scene& scene, Start same_history) {
  State state = make_initial_state(scene);
  OracleElements oracle(scene, state);
  const std::vector<std::vector<int>> walls = walls_of(scene);
  ElementDifferences most;
  for (int n = 0; n < kSteps; ++n) {
    advance_step(scene, state, nullptr);
    for (const std::vector<int>& wall : walls) {
      const std::vector<reference::ElementForces> forces = oracle.advance(state, wall);
      compare_wall(scene, state, wall, forces, oracle.histories, most);
    }
    note_largest(most.plastic_work, (state.ledger.plastic - most.worked) / std::max(most.worked, 1e-3));
    const double stored = oracle.stored();
    note_largest(most.elastic, (evaluate_energies(scene, state).elastic - stored) / std::max(stored, 1e-3));
    if (same_history == Start::of_the_step) {
      oracle.adopt(state);
    }
  }
  return most;
}

class OracleOfElements : public testing::TestWithParam<Rule> {
 protected:
  ~OracleOfElements() override { use_simd_target(""); }

  /// Calls check(scene, whether the law has curves, differences) for every hardening, area rule, precision and kernel
  /// of other bits.
  template <class Check>
  static void compare_all(Start same_history, const Check& check) {
    for (const Hardening& hardening : kHardenings) {
      for (const AreaRule area : {AreaRule::constant_volume, AreaRule::constant_area}) {
        for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
          // Bisections take long: one rule of the kernels' usual counts is enough.
          if (hardening.has_curves() && (GetParam().sections != 2 || same_history == Start::of_the_run ||
                                         precision == Precision::single_precision)) {
            continue;
          }
          const std::shared_ptr<Scene> scene = scenes::build(spec_of(GetParam(), hardening, area, precision));
          impose_random_motions(*scene, kSteps);
          for (const std::string& target : scenes::distinct_targets()) {
            ASSERT_TRUE(use_simd_target(target));
            SCOPED_TRACE(std::string(hardening.name) + " hardening, constant " +
                         (area == AreaRule::constant_area ? "area, " : "volume, ") +
                         (scene->single_fibres ? "single, " : "double, ") + target);
            check(*scene, hardening.has_curves(), compare_elements(*scene, same_history));
          }
        }
      }
    }
  }
};

// Every step from the same history. In double precision the largest difference is 5e-12, and no decision differs. In
// single precision the fibres round stresses of sigma_y by 6e-8 of it, which the flexibility of a section whose fibres
// are all soft makes up to 100 times larger, as it does the strains; by hardening, stresses come to several sigma_y. A
// fibre at the edge may then yield in one of the two alone, in up to 3 of 9840 steps of a wall; these are left out. The
// solver finds flow along a curve to 1e-8 of the stress.
TEST_P(OracleOfElements, TakesEveryStepAsTheSolverDoes) {
  compare_all(Start::of_the_step, [](const Scene& scene, bool has_curves, const ElementDifferences& most) {
    if (has_curves) {
      EXPECT_GT(most.worked, 1000.0);
      scenes::record_bound("stresses along curves at rates", std::max({most.stress, most.plastic_strain}), 1e-8);
      scenes::record_bound("forces and work along curves at rates",
                           std::max({most.force, most.moment, most.plastic_work, most.elastic}), 1e-8);
      return;
    }
    const double bound = scene.single_fibres ? 1e-3 : 1e-9;
    EXPECT_LT(most.plastic_strain, scene.single_fibres ? 1e-2 : bound);
    EXPECT_LT(most.plastic_work, scene.single_fibres ? 1e-4 : 1e-11);
    EXPECT_LT(most.elastic, scene.single_fibres ? 1e-2 : bound);
    EXPECT_LE(most.parted, scene.single_fibres ? 20 : 0);
    const std::string in_single = scene.single_fibres ? " in single precision" : "";
    scenes::record_bound("forces" + in_single, std::max(most.force, most.moment), bound);
    scenes::record_bound("stresses" + in_single, std::max(most.stress, most.borne), scene.single_fibres ? 1e-2 : bound);
    EXPECT_GT(most.worked, 1000.0);
    EXPECT_LT(most.shortest, 0.5);
  });
}

// All steps from the undeformed elements: in double precision differences do not grow, whatever the element. In single
// precision a force-based element in which a fibre has yielded in one of the two alone goes its own way for some steps,
// and its sections share the plastic strain otherwise from then on; the work shows the element.
TEST_P(OracleOfElements, TakesAllStepsAsTheSolverDoes) {
  compare_all(Start::of_the_run, [](const Scene& scene, bool /*has_curves*/, const ElementDifferences& most) {
    if (scene.single_fibres && scene.section.force_based) {
      scenes::record_bound("plastic work of force-based elements in single precision", most.plastic_work, 1e-2);
      return;
    }
    const double bound = scene.single_fibres ? 1e-4 : 1e-9;
    EXPECT_LT(most.force, bound);
    EXPECT_LT(most.moment, bound);
    EXPECT_LT(most.stress, bound);
    EXPECT_LT(most.borne, bound);
    EXPECT_LT(most.plastic_work, 0.01 * bound);
    EXPECT_EQ(most.parted, 0);
    if (!scene.single_fibres) {
      const std::string elements = scene.section.force_based ? "force-based" : "displacement-based";
      scenes::record_bound(elements + " elements", std::max({most.force, most.moment, most.stress}));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Rules, OracleOfElements, testing::ValuesIn(kRules),
                         [](const ::testing::TestParamInfo<Rule>& test) { return test.param.name; });

}  // namespace
}  // namespace cellcrush
