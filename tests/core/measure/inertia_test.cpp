// Inertia's share of the work: what it is, what ends a run with scaled masses, and the theory of such a run.
#include "measure/inertia.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "fields/field_checker.h"
#include "measure/theory.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

SceneSpec scaled(double mass_scaling, double speed) {
  SceneSpec spec = scenes::hexagon_specimen(8, 6);
  spec.loading.speed_m_per_s = speed;
  spec.loading.end_strain = 0.45;
  spec.imperfection = {0.01, 1};
  spec.numerics.mass_scaling = mass_scaling;
  return spec;
}

/// Samples to 60 % strain, of work 1000 times the strain and a kinetic energy of 1.
std::vector<Sample> samples_of_work() {
  std::vector<Sample> samples(600);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].strain = 0.001 * static_cast<double>(i + 1);
    samples[i].energies.external = 1000.0 * samples[i].strain;
    samples[i].energies.kinetic = 1.0;
  }
  return samples;
}

TEST(InertiaShare, IsTheGreatestKineticEnergyOverTheWorkInThePlateauWindow) {
  const auto scene = scenes::build(scenes::hexagon_specimen(8, 6));
  std::vector<Sample> samples = samples_of_work();
  EXPECT_NEAR(*find_inertia_share(*scene, samples), 1.0 / 200.0, 1e-12);
  samples[149].energies.kinetic = 100.0;  // strain 0.15
  samples[449].energies.kinetic = 100.0;
  EXPECT_NEAR(*find_inertia_share(*scene, samples), 1.0 / 200.0, 1e-12) << "the window is 0.2 to 0.4";
  samples[299].energies.kinetic = 30.0;
  EXPECT_NEAR(*find_inertia_share(*scene, samples), 30.0 / 300.0, 1e-12);
  samples.resize(150);
  EXPECT_FALSE(find_inertia_share(*scene, samples)) << "the run ended before the window";
}

TEST(InertiaShare, OfAShortRunIsTakenFromHalfOfItsStrainOn) {
  SceneSpec spec = scenes::hexagon_specimen(8, 6);
  spec.loading.end_strain = 0.15;
  spec.loading.ramp_strain = 0.05;
  const InertiaWindow window = inertia_window_of(*scenes::build(spec));
  EXPECT_NEAR(window.low, 0.075, 1e-3);
  EXPECT_NEAR(window.high, 0.15, 1e-3) << "the last step may go past the end";
}

TEST(InertiaShare, CountsAddedMassAloneAgainstARun) {
  const auto real = scenes::build(scaled(1.0, 100.0));
  EXPECT_EQ(unwanted_share_of(*real, 0.4), 0.0);
  EXPECT_NEAR(unwanted_share_of(*scenes::build(scaled(4.0, 5.0)), 0.4), 0.3, 1e-12);
}

// With real masses inertia is what a fast crush is about. In a shock sigma_0 + D the share is D / (2 sigma), with the
// stresses at both plates as sigma and sigma_0.
TEST(InertiaShare, OfAFastCrushWithRealMassesIsThatOfAShockAndNoWarning) {
  Simulation simulation(scenes::build(scaled(1.0, 100.0)));
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  const Summary summary = summarize(simulation.scene(), samples);
  const double impact = *summary.plateau_stress_impact;
  const double of_shock = 0.5 * (impact - *summary.plateau_stress_support) / impact;
  scenes::record_figure("share in %", 100.0 * *summary.inertia_share, 2, {100.0 * of_shock, 6.0});
  for (const Warning& warning : summary.warnings) {
    EXPECT_NE(warning.kind, Warning::Kind::inertia) << warning.message;
  }
}

TEST(ScaledMasses, OfAMillionfoldAtFiveMetresPerSecondEndTheRunByNameWithARemedy) {
  for (const double scaling : {100.0, 1e4, 1e6}) {
    Simulation simulation(scenes::build(scaled(scaling, 5.0)));
    double last = 0.0;
    scenes::watch(simulation, [&](const Sample& sample) { last = sample.strain; });
    const RunStatus status = simulation.status();
    ASSERT_EQ(status.kind, RunStatus::Kind::inertia) << scaling << ": " << status.message;
    EXPECT_NEAR(last, 0.2, 0.01) << "where the plateau begins";
    EXPECT_NE(status.message.find("numerics.mass_scaling " + to_text(scaling) + " at 5 m/s"), std::string::npos)
        << status.message;
    EXPECT_NE(status.remedy.find("loading.speed_m_per_s"), std::string::npos) << status.remedy;
  }
}

// What the remedy gives is below the warning, and not by an order of magnitude.
TEST(ScaledMasses, OfWhatTheRemedyGivesAreNotWarnedOf) {
  const auto share_with = [](double scaling) {
    Simulation simulation(scenes::build(scaled(scaling, 2.0)));
    const std::vector<Sample> samples = scenes::run_to_end(simulation);
    const Summary summary = summarize(simulation.scene(), samples);
    for (const Warning& warning : summary.warnings) {
      EXPECT_EQ(warning.kind == Warning::Kind::inertia, *summary.inertia_share * (1.0 - 1.0 / scaling) > 0.02);
    }
    return *summary.inertia_share;
  };
  const double much = share_with(25.0);
  const std::string remedy = remedy_for_inertia(*scenes::build(scaled(25.0, 2.0)), 24.0 / 25.0 * much);
  EXPECT_GT(much, kInertiaWarning);
  EXPECT_LT(much, kLargestInertia);
  const double little = share_with(std::stod(remedy.substr(remedy.find("at most ") + 8)));
  EXPECT_LT(little, kInertiaWarning);
  EXPECT_GT(little, 0.1 * kInertiaWarning) << remedy;
}

// Masses times s at V / sqrt(s) make the same crush: Eq. 51 with the masses of the run is the same too.
TEST(ScaledMasses, AreThoseOfTheTheory) {
  const Theory real = theory_of(*scenes::build(scaled(1.0, 50.0)));
  const Theory of_run = theory_of(*scenes::build(scaled(100.0, 5.0)));
  EXPECT_NEAR(of_run.shock, real.shock, 1e-12 * real.shock);
  EXPECT_EQ(of_run.gibson_ashby, real.gibson_ashby);
  EXPECT_EQ(of_run.densification_strain, real.densification_strain);
}

}  // namespace
}  // namespace cellcrush
