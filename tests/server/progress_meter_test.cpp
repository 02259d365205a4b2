#include "worker/progress_meter.h"

#include <gtest/gtest.h>

namespace cellcrush::worker {
namespace {

using std::chrono::milliseconds;

v1::Sample sample_at(double strain, double stress) {
  v1::Sample out;
  out.set_strain(strain);
  out.set_stress_impact_mpa(stress);
  return out;
}

TEST(ProgressMeter, SpeaksAtMostFiveTimesASecond) {
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(1000, 0.2, 0.4, start);
  int told = 0;
  for (int ms = 10; ms <= 2000; ms += 10)
    told += meter.read(ms / 10, 0.0, start + milliseconds(ms)).has_value() ? 1 : 0;
  EXPECT_EQ(told, 10);
}

TEST(ProgressMeter, ASteadySpeedGivesTheTimeLeft) {
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(1000, 0.2, 0.4, start);
  std::optional<v1::Progress> progress;
  for (int i = 1; i <= 4; ++i) progress = meter.read(50 * i, 0.1, start + milliseconds(500 * i));
  ASSERT_TRUE(progress);
  EXPECT_NEAR(progress->steps_per_second(), 100.0, 1e-9);
  EXPECT_NEAR(progress->seconds_left(), 8.0, 1e-9);
  EXPECT_NEAR(progress->fraction(), 0.2, 1e-12);
}

TEST(ProgressMeter, ThePlateauIsTheMeanOverTheWindowAlone) {
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(1000, 0.2, 0.4, start);
  meter.add(sample_at(0.1, 100.0));
  EXPECT_FALSE(meter.read(1, 0.1, start + milliseconds(300))->has_plateau_so_far_mpa());
  // Half of this interval and half of the last one lie in the window.
  meter.add(sample_at(0.3, 2.0));
  meter.add(sample_at(0.5, 4.0));
  meter.add(sample_at(0.6, 100.0));
  EXPECT_NEAR(meter.read(2, 0.6, start + milliseconds(600))->plateau_so_far_mpa(), 3.0, 1e-12);
}

}  // namespace
}  // namespace cellcrush::worker
