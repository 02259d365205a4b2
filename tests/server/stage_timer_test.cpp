#include "worker/stage_timer.h"

#include <gtest/gtest.h>

#include "worker/processor_time.h"

namespace cellcrush::worker {
namespace {

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

}  // namespace
}  // namespace cellcrush::worker
