#include "worker/stage_timer.h"

namespace cellcrush::worker {

void StageTimer::begin(Stage stage) {
  if (steps_ % interval_ != 0) return;
  const double now = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
  close(now);
  stage_ = static_cast<int>(stage);
  since_ = now;
}

void StageTimer::end_step() {
  if (stage_ >= 0) {
    close(processor_seconds(CLOCK_THREAD_CPUTIME_ID));
    stage_ = -1;
    ++timed_steps_;
  }
  ++steps_;
}

std::array<double, kStageCount> StageTimer::seconds() const {
  std::array<double, kStageCount> all = timed_seconds_;
  const double steps_of_each = timed_steps_ > 0 ? static_cast<double>(steps_) / static_cast<double>(timed_steps_) : 0.0;
  for (std::size_t stage = 0; stage < all.size(); ++stage) {
    all[stage] = earlier_seconds_[stage] + all[stage] * steps_of_each;
  }
  return all;
}

void StageTimer::close(double now) {
  if (stage_ >= 0) timed_seconds_[static_cast<std::size_t>(stage_)] += now - since_;
}

}  // namespace cellcrush::worker
