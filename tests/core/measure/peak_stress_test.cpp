// The peak stress: its filter against known forces, and that neither samples nor checkpoints move it.
#include "measure/peak_stress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/byte_stream.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::peaks {
namespace {

SceneSpec crush(int samples, double speed, double end_strain) {
  SceneSpec spec = scenes::hexagon_specimen(12, 10);
  spec.loading.speed_m_per_s = speed;
  spec.loading.end_strain = end_strain;
  spec.imperfection = {0.01, 1};
  spec.output.sample_count = samples;
  return spec;
}

// Stress 1 MPa, 3 MPa between 0.1 and 0.105 of strain, and a vibration of ten times that.
TEST(PeakStress, IsTheMeanOfItsWindowWhateverVibrates) {
  const auto scene = scenes::build(crush(100, 100.0, 0.4));
  State state;
  PeakWatch watch;
  const std::int64_t interval = PeakWatch::interval(*scene);
  const double speed = scene->plates.speed;
  for (std::int64_t step = interval; state.impact_travel < 0.3 * scene->length; step += interval) {
    state.time = static_cast<double>(step) * scene->schedule.time_step;
    state.impact_travel = speed * state.time;
    const double strain = state.impact_travel / scene->length;
    const double mean = strain + 2.0 * std::clamp(strain - 0.1, 0.0, 0.005);
    const double vibration = 10.0 * std::sin(2.0 * std::numbers::pi * strain / 1e-4) * 1e-4 / (2.0 * std::numbers::pi);
    state.impact_impulse = scene->width * scene->depth * scene->length / speed * (mean + vibration);
    watch.look(*scene, state);
  }
  EXPECT_NEAR(watch.peak().stress, 2.0, 0.05);
  EXPECT_NEAR(watch.peak().strain, 0.1025, 0.004);
}

TEST(PeakStress, IsThatOfAnyNumberOfSamplesWhereTheGreatestOfThemIsNot) {
  double of_raw[2] = {0.0, 0.0};
  std::vector<double> peaks;
  for (const int samples : {100, 400, 2000}) {
    const auto scene = scenes::build(crush(samples, 100.0, 0.5));
    Simulation simulation(scene);
    const std::vector<Sample> all = scenes::run_to_end(simulation);
    const Summary summary = summarize(*scene, all);
    ASSERT_TRUE(summary.peak) << samples;
    peaks.push_back(summary.peak->stress);
    const double raw = std::ranges::max(all, {}, &Sample::stress_impact).stress_impact;
    if (samples == 100) of_raw[0] = raw;
    if (samples == 2000) of_raw[1] = raw;
    EXPECT_GT(summary.peak->stress, 0.9 * *summary.plateau_stress_impact);
  }
  const auto [least, most] = std::ranges::minmax(peaks);
  scenes::record_figure("raw: 2000 samples over 100", of_raw[1] / of_raw[0], 2);
  EXPECT_GT(of_raw[1], 1.5 * of_raw[0]);
  scenes::record_bound("peak", most / least - 1.0, 0.02);
}

TEST(PeakStress, GoesOnFromACheckpointWithTheSameBits) {
  const auto scene = scenes::build(crush(50, 100.0, 0.1));
  Simulation whole(scene);
  const Sample last = scenes::run_to_end(whole).back();
  Simulation first(scene);
  first.advance(last.step / 3);
  std::string bytes;
  first.checkpoint(append_to(bytes));
  Simulation second(scene);
  ASSERT_TRUE(second.restore(source_of(bytes)));
  const Sample resumed = scenes::run_to_end(second).back();
  EXPECT_GT(last.peak.stress, 0.0);
  EXPECT_EQ(resumed.peak.stress, last.peak.stress);
  EXPECT_EQ(resumed.peak.strain, last.peak.strain);
}

TEST(PeakStress, IsAbsentBeforeTheFirstWindowIsComplete) {
  const auto scene = scenes::build(crush(50, 100.0, 0.008));
  Simulation simulation(scene);
  EXPECT_FALSE(summarize(*scene, scenes::run_to_end(simulation)).peak);
}

}  // namespace
}  // namespace cellcrush::peaks
