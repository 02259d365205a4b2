#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "cellcrush/simd.h"
#include "cellcrush/state.h"
#include "core/oracle/lattice_of_scene.h"
#include "core/reference/reference_element.h"
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

  friend void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }
};

constexpr Rule kRules[] = {
    {"Paper", Formulation::displacement_based, DepthRule::lobatto, 2, 6},
    {"Default", Formulation::force_based, DepthRule::full_moment, 4, 6},
    {"DisplacementBased1x2", Formulation::displacement_based, DepthRule::lobatto, 1, 2},
    {"DisplacementBased2x6FullMoment", Formulation::displacement_based, DepthRule::full_moment, 2, 6},
    {"DisplacementBased3x4", Formulation::displacement_based, DepthRule::full_moment, 3, 4},
    {"DisplacementBased5x8", Formulation::displacement_based, DepthRule::lobatto, 5, 8},
    {"ForceBased3x4", Formulation::force_based, DepthRule::full_moment, 3, 4},
    {"ForceBased4x6Lobatto", Formulation::force_based, DepthRule::lobatto, 4, 6},
    {"ForceBased5x8", Formulation::force_based, DepthRule::lobatto, 5, 8},
    {"ForceBased5x10", Formulation::force_based, DepthRule::lobatto, 5, 10},
};

struct Hardening {
  const char* name;
  double modulus;  // MPa
  double isotropic_fraction;
};

constexpr Hardening kHardenings[] = {
    {"none", 0.0, 1.0}, {"isotropic", 700.0, 1.0}, {"kinematic", 700.0, 0.0}, {"mixed", 700.0, 0.4}};

/// Elements side by side: a full block of walls, and some that remain.
constexpr int kElements = 19;
constexpr int kSteps = 240;

/// An element a beam, none joined, of three thicknesses and two materials.
SceneSpec spec_of(const Rule& rule, const Hardening& hardening, AreaRule area, Precision precision) {
  FrameLattice frame;
  for (int e = 0; e < kElements; ++e) {
    const double length = 3.0 + 0.1 * e;
    frame.nodes.push_back({10.0 * e, 0.0, 0.0, 0.0});
    frame.nodes.push_back({10.0 * e + length * std::cos(0.7 * e), length * std::sin(0.7 * e), 0.0, 0.0});
    frame.beams.push_back(scenes::beam(2 * e, 2 * e + 1, 0.2 + 0.15 * (e % 3), 1));
  }
  SceneSpec spec = scenes::elastic_frame(frame);
  spec.depth_mm = 2.5;
  spec.material.youngs_modulus_mpa = 69000.0;
  spec.material.yield_stress_mpa = 76.0;
  spec.material.hardening_modulus_mpa = hardening.modulus;
  spec.material.isotropic_fraction = hardening.isotropic_fraction;
  MaterialSpec other = spec.material;
  other.youngs_modulus_mpa = 41000.0;
  other.yield_stress_mpa = 120.0;
  auto& beams = std::get<FrameLattice>(spec.lattice).beams;
  for (int e = 0; e < kElements; e += 4) {
    beams[e].material = other;
  }
  spec.section = {rule.formulation, rule.depth_rule, area, rule.sections, rule.points};
  spec.numerics.fibre_precision = precision;
  return spec;
}

/// Random numbers that are the same everywhere.
class Draw {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 generator_{20261123};
};

/// A number that goes up and down between two bounds in random strides.
class Walk {
 public:
  Walk(double start, double low, double high, double stride)
      : value_(start), low_(low), high_(high), most_(std::abs(stride)), stride_(stride) {}

  double next(Draw& draw) {
    if (draw.between(0.0, 1.0) < 0.04) {
      stride_ = draw.between(-most_, most_);
    }
    if (value_ + stride_ < low_ || value_ + stride_ > high_) {
      stride_ = -stride_;
    }
    return value_ += stride_;
  }

 private:
  double value_;
  double low_;
  double high_;
  double most_;
  double stride_;
};

/// Makes the ends of every element follow paths of stretch, squashing, bending, drift and many turns, step by step.
void impose_motions(Scene& scene) {
  Draw draw;
  const auto follow = [&](Hold& hold, const std::vector<double>& values) {
    hold = {true, static_cast<int>(scene.motions.size())};
    TimeFunction motion;
    for (std::size_t n = 0; n < values.size(); ++n) {
      motion.points.emplace_back(static_cast<double>(n) * scene.schedule.time_step, values[n]);
    }
    scene.motions.push_back(motion);
  };
  scene.supports.assign(scene.particle_count(), {});
  for (int e = 0; e < kElements; ++e) {
    const Vector2 first = scene.position[2 * e];
    const Vector2 last = scene.position[2 * e + 1];
    const double length = (last - first).norm();
    const double angle = std::atan2(last.y() - first.y(), last.x() - first.x());
    const double stride = std::pow(10.0, draw.between(-4.5, -2.3));  // of strain; the yield strain is 1.1e-3
    Walk stretch(1.0, 0.35, 1.25, e % 2 == 0 ? stride : -stride);
    Walk turn(0.0, -1e9, 1e9, draw.between(0.0, 0.15));
    Walk bend_first(0.0, -0.6, 0.6, 4.0 * stride);
    Walk bend_last(0.0, -0.6, 0.6, 4.0 * stride);
    Walk drift(0.0, -50.0, 50.0, 0.1);
    std::vector<double> path[6] = {{0.0}, {0.0}, {0.0}, {0.0}, {0.0}, {0.0}};
    for (int n = 0; n < kSteps; ++n) {
      const double turned = turn.next(draw);
      const Vector2 start = first + Vector2(drift.next(draw), drift.next(draw));
      const Vector2 end =
          start + length * stretch.next(draw) * Vector2(std::cos(angle + turned), std::sin(angle + turned));
      const double values[] = {start.x() - first.x(), start.y() - first.y(), turned + bend_first.next(draw),
                               end.x() - last.x(),    end.y() - last.y(),    turned + bend_last.next(draw)};
      for (int k = 0; k < 6; ++k) {
        path[k].push_back(values[k]);
      }
    }
    follow(scene.supports[2 * e].x, path[0]);
    follow(scene.supports[2 * e].y, path[1]);
    follow(scene.supports[2 * e].rotation, path[2]);
    follow(scene.supports[2 * e + 1].x, path[3]);
    follow(scene.supports[2 * e + 1].y, path[4]);
    follow(scene.supports[2 * e + 1].rotation, path[5]);
  }
}

/// Largest differences between the running solver and the oracle.
struct ElementDifferences {
  double force = 0.0;           // over sigma_y A
  double moment = 0.0;          // over sigma_y A h
  double stress = 0.0;          // and back stress, over sigma_y
  double plastic_strain = 0.0;  // over sigma_y / E
  double shortfall = 0.0;       // u_i / (A h), over sigma_y
  double flexibility = 0.0;     // of itself
  double plastic_work = 0.0;    // of the work so far

  double squared_forces = 0.0;  // sum over all elements and steps
  double worked = 0.0;          // N mm, by the oracle
  double shortest = 1.0;        // l / l_0
};

void note_largest(double& greatest, double difference) { greatest = std::max(greatest, std::abs(difference)); }

void note_forces(const State& state, const Element& element, const reference::ElementData& data,
                 const reference::ElementForces& forces, ElementDifferences& most) {
  const double yield_force = data.material.yield_stress * data.depth * data.thickness;
  const double at_start = (state.internal_force[element.start] - forces.on_end).norm() / yield_force;
  note_largest(most.force, at_start);
  note_largest(most.force, (state.internal_force[element.end] + forces.on_end).norm() / yield_force);
  most.squared_forces += at_start * at_start;
  const double yield_moment = yield_force * data.thickness;
  note_largest(most.moment, (state.internal_moment[element.start] + forces.moment_on_start) / yield_moment);
  note_largest(most.moment, (state.internal_moment[element.end] + forces.moment_on_end) / yield_moment);
}

void note_histories(const reference::ElementHistory& solver, const reference::ElementHistory& oracle,
                    const reference::ElementData& data, bool has_hardening, ElementDifferences& most) {
  const double yield = data.material.yield_stress;
  for (std::size_t f = 0; f < oracle.fibres.size(); ++f) {
    note_largest(most.stress, (solver.fibres[f].stress - oracle.fibres[f].stress) / yield);
    if (has_hardening) {
      note_largest(most.stress, (solver.fibres[f].back_stress - oracle.fibres[f].back_stress) / yield);
      note_largest(most.plastic_strain,
                   (solver.fibres[f].plastic_strain - oracle.fibres[f].plastic_strain) * data.material.modulus / yield);
    }
  }
  for (std::size_t s = 0; s < oracle.flexibility.size(); ++s) {
    note_largest(most.shortfall, (solver.shortfall[s] - oracle.shortfall[s]) / yield);
    note_largest(most.flexibility, solver.flexibility[s] / oracle.flexibility[s] - 1.0);
  }
}

enum class Start { of_the_step, of_the_run };

/// Moves the solver and takes the same motion through the oracle, whose elements have the solver's histories at the
/// start of every step, or only of the run.
ElementDifferences compare_elements(const Scene& scene, Start same_history) {
  const reference::ElementRule rule = element_rule_of(scene);
  const double dt = scene.schedule.time_step;
  State state = make_initial_state(scene);
  std::vector<reference::ElementHistory> histories;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    histories.push_back(element_history_of(scene, state, e));
  }
  ElementDifferences most;
  for (int n = 0; n < kSteps; ++n) {
    advance_step(scene, state, nullptr);
    for (std::size_t e = 0; e < scene.element_count(); ++e) {
      const auto& [start, end, thickness, material] = scene.elements[e];
      const reference::ElementData data = element_data_of(scene, e);
      const reference::ElementForces forces = advance_element(
          rule, data, {state.position[start], state.position[end], dt * state.spin[start], dt * state.spin[end]},
          histories[e]);
      most.worked += forces.plastic_work;
      note_forces(state, scene.elements[e], data, forces, most);
      const reference::ElementHistory solver = element_history_of(scene, state, e);
      note_histories(solver, histories[e], data, scene.has_hardening(), most);
      most.shortest = std::min(most.shortest, solver.length / data.undeformed_length);
      if (same_history == Start::of_the_step) {
        histories[e] = solver;
      }
    }
    note_largest(most.plastic_work, (state.ledger.plastic - most.worked) / std::max(most.worked, 1e-3));
  }
  return most;
}

class OracleOfElements : public testing::TestWithParam<Rule> {
 protected:
  ~OracleOfElements() override { use_simd_target(""); }

  /// Calls check(scene, differences) for every hardening, area rule, precision and vector kernel.
  template <class Check>
  static void compare_all(Start same_history, const Check& check) {
    for (const Hardening& hardening : kHardenings) {
      for (const AreaRule area : {AreaRule::constant_volume, AreaRule::constant_area}) {
        for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
          const std::shared_ptr<Scene> scene = scenes::build(spec_of(GetParam(), hardening, area, precision));
          impose_motions(*scene);
          for (const std::string& target : simd_targets()) {
            ASSERT_TRUE(use_simd_target(target));
            SCOPED_TRACE(std::string(hardening.name) + " hardening, constant " +
                         (area == AreaRule::constant_area ? "area, " : "volume, ") +
                         (scene->single_fibres ? "single, " : "double, ") + target);
            check(*scene, compare_elements(*scene, same_history));
          }
        }
      }
    }
  }
};

// Every step from the same history. In double precision the largest difference is 2e-11 (flexibility: 3e-8): rounding,
// which the quotient that gives a section's flexibility makes a thousand times larger. In single precision fibres
// round stresses of sigma_y by 6e-8 of it; in a section near its full plastic moment the same quotient makes up to
// 9e-4 of that. Flexibilities are then known to nothing better than a third, and are left out.
TEST_P(OracleOfElements, TakesEveryStepAsTheSolverDoes) {
  compare_all(Start::of_the_step, [](const Scene& scene, const ElementDifferences& most) {
    const double bound = scene.single_fibres ? 1e-4 : 1e-9;
    EXPECT_LT(most.force, bound);
    EXPECT_LT(most.moment, bound);
    EXPECT_LT(most.shortfall, bound);
    EXPECT_LT(most.plastic_work, 0.01 * bound);
    EXPECT_LT(most.stress, scene.single_fibres ? 1e-2 : bound);
    EXPECT_LT(most.plastic_strain, scene.single_fibres ? 1e-2 : bound);
    const std::string in_single = scene.single_fibres ? " in single precision" : "";
    scenes::record_bound("forces" + in_single, std::max({most.force, most.moment, most.shortfall}));
    scenes::record_bound("stresses" + in_single, most.stress);
    if (!scene.single_fibres) {
      EXPECT_LT(most.flexibility, 1e-6);
    }
    EXPECT_GT(most.worked, 1000.0);
    EXPECT_LT(most.shortest, 0.5);
  });
}

// All steps from the undeformed elements. The strains of a displacement-based element are given by its motion, so
// differences do not grow. Those of a force-based element depend on the flexibilities that its sections showed: a
// difference grows from step to step while sections yield, until they unload. It then passes through forces of up to
// 0.05 of the yield force for some steps; the mean and the work show the element.
TEST_P(OracleOfElements, TakesAllStepsAsTheSolverDoes) {
  compare_all(Start::of_the_run, [](const Scene& scene, const ElementDifferences& most) {
    const double mean_force = std::sqrt(most.squared_forces / (kSteps * kElements));
    if (scene.section.force_based) {
      EXPECT_LT(mean_force, 1e-2);
      EXPECT_LT(most.plastic_work, 1e-3);
      scenes::record_bound("plastic work of force-based elements", most.plastic_work);
    } else {
      const double bound = scene.single_fibres ? 1e-4 : 1e-9;
      EXPECT_LT(most.force, bound);
      EXPECT_LT(most.moment, bound);
      EXPECT_LT(most.stress, bound);
      EXPECT_LT(most.plastic_work, 0.01 * bound);
      if (!scene.single_fibres) {
        scenes::record_bound("displacement-based elements", std::max({most.force, most.moment, most.stress}));
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Rules, OracleOfElements, testing::ValuesIn(kRules),
                         [](const testing::TestParamInfo<Rule>& test) { return test.param.name; });

}  // namespace
}  // namespace cellcrush
