#include <gtest/gtest.h>

#include <cmath>

#include "cellcrush/simulation.h"
#include "measure/theory.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

class SummaryTest : public testing::Test {
 protected:
  /// Samples to 60 % strain, both plates at 1 MPa, plastic work growing from 2 % strain on.
  static std::vector<Sample> steady_samples() {
    std::vector<Sample> samples;
    for (int i = 1; i <= 600; ++i) {
      Sample sample;
      sample.strain = 0.001 * i;
      sample.stress_impact = 1.0;
      sample.stress_support = 1.0;
      sample.energies.elastic = 10.0;
      sample.energies.plastic = std::max(0.0, 1000.0 * (sample.strain - 0.02));
      sample.energies.kinetic = 1.0;
      samples.push_back(sample);
    }
    return samples;
  }

  std::shared_ptr<Scene> scene_ = scenes::build(scenes::hexagon_specimen(20, 7));
};

TEST_F(SummaryTest, PlatesAreComparedByTheirMeansBeyondFivePercentOfStrain) {
  std::vector<Sample> samples = steady_samples();
  for (Sample& sample : samples) {
    // A difference that rings cancels in the means; one before 5 % strain does not count; one over 2 % of strain does.
    sample.stress_impact += std::lround(1000.0 * sample.strain) % 2 == 0 ? 0.3 : -0.3;
    if (sample.strain < 0.0495) sample.stress_impact += 5.0;
    if (sample.strain > 0.2005 && sample.strain < 0.2205) sample.stress_impact += 0.2;
  }
  const auto found = summarize(*scene_, samples).quasi_static;
  ASSERT_TRUE(found);
  const double window = 0.2 * 0.02 / 0.05;
  EXPECT_NEAR(found->plate_difference_greatest, window / (1.0 + 0.5 * window), 1e-6);
  const double whole = 0.2 * 0.02 / 0.55;
  EXPECT_NEAR(found->plate_difference, whole / (1.0 + 0.5 * whole), 1e-6);
}

TEST_F(SummaryTest, LedgerErrorOfARunThatOnlyItsInitialEnergyDrivesIsRelativeToThat) {
  std::vector<Sample> samples(10);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].energies.initial = 100.0;
    samples[i].energies.kinetic = 100.0 - 10.0 * static_cast<double>(i);
    samples[i].energies.plastic = 9.5 * static_cast<double>(i);
    samples[i].energies.residual = 0.5 * static_cast<double>(i);
  }
  EXPECT_NEAR(summarize(*scene_, samples).energy_error_relative, 4.5 / 110.0, 0.005);
}

TEST_F(SummaryTest, KineticEnergyIsHeldAgainstPlasticWorkOnceThatOutweighsTheElastic) {
  // At 5 % strain 30 of plastic work outweigh the 10 of elastic energy.
  EXPECT_NEAR(summarize(*scene_, steady_samples()).quasi_static->kinetic_share, 1.0 / 30.0, 1e-9);
  std::vector<Sample> springy = steady_samples();
  for (Sample& sample : springy) sample.energies.elastic = 100.0;  // outweighed from 12 % strain on
  EXPECT_NEAR(summarize(*scene_, springy).quasi_static->kinetic_share, 1.0 / 101.0, 1e-4);
}

TEST_F(SummaryTest, AShortRunIsNotComparedAtAll) {
  std::vector<Sample> samples = steady_samples();
  samples.resize(95);
  EXPECT_FALSE(summarize(*scene_, samples).quasi_static);
}

TEST_F(SummaryTest, TheCrushModeIsWhatMostLooksSay) {
  std::vector<Sample> samples = steady_samples();
  EXPECT_EQ(summarize(*scene_, samples).crush_mode, CrushMode::none);
  EXPECT_FALSE(summarize(*scene_, samples).crush_mode_strain);
  samples[100].crush_mode = CrushMode::v;
  samples[150].crush_mode = CrushMode::i;
  EXPECT_EQ(summarize(*scene_, samples).crush_mode, CrushMode::v) << "the earlier of equals";
  samples[200].crush_mode = CrushMode::i;
  const Summary summary = summarize(*scene_, samples);
  EXPECT_EQ(summary.crush_mode, CrushMode::i);
  EXPECT_NEAR(*summary.crush_mode_strain, 0.151, 1e-12);
}

TEST_F(SummaryTest, TheTheorysErrorIsItsExcessOverThePlateau) {
  const Summary summary = summarize(*scene_, steady_samples());
  ASSERT_TRUE(summary.shock_error());
  EXPECT_NEAR(*summary.shock_error(), summary.theory.shock - 1.0, 1e-9);
  EXPECT_FALSE(summary.front_shock_error()) << "no sample has a front";
}

TEST_F(SummaryTest, SolidFractionAtDensificationFollowsFromTheStrain) {
  std::vector<Sample> samples = steady_samples();
  for (Sample& sample : samples) {
    if (sample.strain > 0.5) sample.stress_impact = sample.stress_support = 1.0 + 50.0 * (sample.strain - 0.5);
  }
  const Summary summary = summarize(*scene_, samples);
  ASSERT_TRUE(summary.densification_strain && summary.solid_fraction_at_densification);
  EXPECT_NEAR(*summary.solid_fraction_at_densification,
              relative_density_of(*scene_) / (1.0 - *summary.densification_strain), 1e-12);
}

}  // namespace
}  // namespace cellcrush
