// What a worker reports of its time and progress.
#include <gtest/gtest.h>

#include "worker/run_output.h"
#include "worker/stage_timer.h"

namespace cellcrush::worker {
namespace {

using std::chrono::milliseconds;

/// Keeps this thread busy for `ms` milliseconds of its own time, however busy the machine is.
void spend(int ms) {
  const double end = processor_seconds(CLOCK_THREAD_CPUTIME_ID) + 1e-3 * ms;
  while (processor_seconds(CLOCK_THREAD_CPUTIME_ID) < end) {
  }
}

/// A step of two stages.
void step(StageTimer& timer, int first, int second) {
  using enum Stage;
  timer.begin(integrate_motion);
  spend(first);
  timer.begin(find_contacts);
  spend(second);
  timer.end_step();
}

TEST(StageTimer, GivesEachStageItsTime) {
  StageTimer timer(1);
  step(timer, 2, 6);
  spend(20);  // between steps: no stage's
  step(timer, 2, 6);
  const auto seconds = timer.seconds();
  EXPECT_GE(seconds[0], 0.004);
  EXPECT_GE(seconds[2], 0.012);
  EXPECT_EQ(seconds[1] + seconds[3] + seconds[4] + seconds[5], 0.0);
}

TEST(StageTimer, TakesWhatItDidNotLookAtAsTheMeanOfWhatItDid) {
  StageTimer every(1);
  StageTimer third(3);
  for (int i = 0; i < 9; ++i) {
    // Only every third step takes time, and those are the ones that are looked at.
    const int time = i % 3 == 0 ? 3 : 0;
    step(every, time, time);
    step(third, time, time);
  }
  EXPECT_GE(every.seconds()[0], 0.009);
  EXPECT_GE(third.seconds()[0], 0.027);
  EXPECT_GT(third.seconds()[0], 1.5 * every.seconds()[0]);
}

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
