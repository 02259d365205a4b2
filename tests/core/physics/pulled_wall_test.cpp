// Walls that are pulled or stretched: their force, whatever the mesh, and their energy, whatever the area rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

using Component = FrameLattice::Component;

/// A wall of Type I, 1 mm deep.
struct Wall {
  static constexpr double kModulus = 69000.0;
  static constexpr double kYieldStress = 76.0;
  static constexpr double kSide = 4.0;
  static constexpr double kThickness = 0.3464;
  static constexpr double kYieldForce = kYieldStress * kThickness;
};

/// A wall along x, held at its start, whose end moves along x only. `steps` of the chosen size.
SceneSpec pulled_wall(int elements, double elongation, double steps, double hardening = 0.0) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {Wall::kSide, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, Wall::kThickness, elements)};
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  SceneSpec spec = scenes::elastic_frame(frame);
  spec.material.youngs_modulus_mpa = Wall::kModulus;
  spec.material.yield_stress_mpa = Wall::kYieldStress;
  spec.material.hardening_modulus_mpa = hardening;
  spec.numerics.mass_damping_per_s = 1e5;
  const double end = steps * scenes::build(spec)->schedule.time_step;
  spec.loads.motions = {{1, Component::x, {{0.0, 0.0}, {end, elongation}}}};
  spec.loading.end_time_s = end;
  return spec;
}

double force_on_start(const Simulation& simulation) { return simulation.state().internal_force[0].x(); }

// At constant volume its elements would neck one by one: to 0.83, 0.71, 0.56, 0.39 and 0.24 of the yield force.
TEST(PulledWall, PerfectlyPlasticBearsItsYieldForceWhateverItsMesh) {
  constexpr double kElongation = 0.2 * Wall::kSide;
  double worst_force = 0.0;
  double worst_work = 0.0;
  for (const int elements : {1, 2, 4, 8, 16}) {
    Simulation simulation(scenes::build(pulled_wall(elements, kElongation, 20000.0 * std::max(1, elements / 2))));
    simulation.advance(simulation.scene().schedule.step_count);
    const double force = force_on_start(simulation) / Wall::kYieldForce;
    const double work = simulation.take_sample().energy_plastic / (Wall::kYieldForce * kElongation);
    EXPECT_NEAR(force, 1.0, 1e-3) << elements << " elements";
    EXPECT_NEAR(work, 1.0, 0.01) << elements << " elements";
    worst_force = std::max(worst_force, std::abs(force - 1.0));
    worst_work = std::max(worst_work, std::abs(work - 1.0));
  }
  scenes::record_bound("worst error of the force in %", std::max(1e-10, 100.0 * worst_force));
  scenes::record_figure("worst error of the work in %", 100.0 * worst_work, 1);
}

/// Warnings of a wall that is pulled by so many times its thickness.
std::vector<Warning> warnings_of(double thicknesses, double hardening) {
  Simulation simulation(scenes::build(pulled_wall(4, thicknesses * Wall::kThickness, 20000.0, hardening)));
  std::vector<Sample> samples;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(100);
    samples.push_back(simulation.take_sample());
  }
  return summarize(simulation.scene(), samples).warnings;
}

TEST(PulledWall, StretchedByMoreThanItsThicknessIsReportedWithItsPlace) {
  EXPECT_TRUE(warnings_of(0.95, 0.0).empty());
  const std::vector<Warning> warnings = warnings_of(1.2, 0.0);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings.front().kind, Warning::Kind::walls_neck);
  EXPECT_NE(warnings.front().message.find("starts at particle 0, at (0, 0) mm"), std::string::npos)
      << warnings.front().message;
}

// With H = 2 sigma_y the force of a wall grows up to a strain of 1/2 (Considere).
TEST(PulledWall, ThatHardensIsNotReportedWhileItStretchesEvenly) {
  EXPECT_TRUE(warnings_of(1.2, 2.0 * Wall::kYieldStress).empty());
}

/// The greatest residual of the ledger over the greatest elastic energy of a wall that is stretched, bent, released and
/// straightened: a cycle that gives its work back.
double residual_of_cycle(const SectionSpec& section, int elements, double strain) {
  SceneSpec spec = pulled_wall(elements, 0.0, 20000.0);
  spec.section = section;
  spec.material.yield_stress_mpa = 1e6;
  spec.numerics.mass_damping_per_s = 2e5;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  auto& frame = std::get<FrameWalls>(spec.lattice);
  const double end = *spec.loading.end_time_s;
  const double stretch = strain * Wall::kSide;
  frame.supports[1].fix_rotation = false;
  spec.loads.motions = {
      {1, Component::x, {{0.0, 0.0}, {end / 4, stretch}, {end / 2, stretch}, {3 * end / 4, 0.0}}},
      {1, Component::rotation, {{0.0, 0.0}, {end / 4, 0.0}, {end / 2, 0.5}, {3 * end / 4, 0.5}, {end, 0.0}}}};
  Simulation simulation(scenes::build(spec));
  double residual = 0.0;
  double elastic = 0.0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(200);
    const Sample sample = simulation.take_sample();
    residual = std::max(residual, std::abs(sample.energy_residual));
    elastic = std::max(elastic, sample.energy_elastic);
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return residual / elastic;
}

// Strains over the current length with a constant area open the ledger by a third of the strain, here 3 %.
TEST(StretchedWall, GivesItsWorkBackByEitherAreaRule) {
  using AreaRule = SectionSpec::AreaRule;
  using Formulation = SectionSpec::Formulation;
  for (const AreaRule area : {AreaRule::constant_volume, AreaRule::constant_area}) {
    for (const Formulation formulation : {Formulation::force_based, Formulation::displacement_based}) {
      for (const auto& [elements, strain] : {std::pair(1, 0.1), {2, 0.1}, {1, -0.04}, {2, -0.03}}) {
        SectionSpec section;
        section.area_rule = area;
        section.formulation = formulation;
        const double residual = residual_of_cycle(section, elements, strain);
        EXPECT_LT(residual, 1e-5) << elements << " elements, strain " << strain;
        scenes::record_bound("residual over the elastic energy", residual);
      }
    }
  }
}

double residual_of_hardening_wall(double steps) {
  Simulation simulation(scenes::build(pulled_wall(2, 0.05 * Wall::kSide, steps, Wall::kModulus / 9.0)));
  simulation.advance(simulation.scene().schedule.step_count);
  const Sample sample = simulation.take_sample();
  return std::abs(sample.energy_residual) / sample.work_external;
}

// With the plastic work at the returned stress alone: 0.21 % and 0.06 %, of order 1.
TEST(HardeningWall, LedgerClosesAsTheSquareOfTheStep) {
  const double coarse = residual_of_hardening_wall(300.0);
  const double fine = residual_of_hardening_wall(900.0);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(std::log(coarse / fine) / std::log(3.0), 1.7) << coarse << " to " << fine;
  scenes::record_figure("residual in %", 100.0 * coarse, 1);
}

// With a tangent of no more than E_T in the balance of the sections (E5d), it opens by 2.8 %.
TEST(HardeningCrush, OfAHundredthOfTheModulusClosesItsLedger) {
  SceneSpec spec = scenes::hexagon_specimen(10, 5);
  spec.material.hardening_modulus_mpa = Wall::kModulus / 99.0;
  spec.imperfection.amplitude_mm = 0.01;
  spec.loading.end_strain = 0.2;
  Simulation simulation(scenes::build(spec));
  std::vector<Sample> samples;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(simulation.scene().schedule.sample_interval);
    samples.push_back(simulation.take_sample());
  }
  const double residual = summarize(simulation.scene(), samples).energy_error_relative;
  EXPECT_LT(residual, 0.01);
  scenes::record_figure("residual in %", 100.0 * residual, 1);
}

/// Greatest relative error of the force of an elastic wall of one element, from a fifth of its yield strain on.
double error_of_slow_pull(double steps, bool single) {
  constexpr double kStrain = 0.99 * Wall::kYieldStress / Wall::kModulus;
  const auto scene = scenes::build(pulled_wall(1, kStrain * Wall::kSide, steps));
  EXPECT_EQ(scene->single_fibres, single) << steps;
  EXPECT_EQ(scene->slow_loading, !single) << steps;
  Simulation simulation(scene);
  double worst = 0.0;
  for (int i = 1; i <= 50; ++i) {
    simulation.advance(static_cast<std::int64_t>(steps) / 50);
    const double exact = Wall::kModulus * Wall::kThickness * (simulation.state().length[0] / Wall::kSide - 1.0);
    worst = i > 10 ? std::max(worst, std::abs(force_on_start(simulation) / exact - 1.0)) : 0.0;
  }
  return worst;
}

// In single precision, 0.2 % of the force are rounded away over 300,000 steps, and 0.6 % over a million.
TEST(SlowLoading, IsNotRoundedAway) {
  const double slow = error_of_slow_pull(300000.0, false);
  EXPECT_LT(slow, 1e-8);
  scenes::record_bound("error of slow loading", slow);
  const double fast = error_of_slow_pull(25000.0, true);
  EXPECT_LT(fast, 5e-4);
  scenes::record_bound("error in single precision in %", 100.0 * fast);
}

}  // namespace
}  // namespace cellcrush
