#include "worker/stage_timer.h"

namespace cellcrush::worker {

void StageTimer::begin(Stage stage) {
  if (steps_ % interval_ != 0) return;
  const Clock::time_point now = Clock::now();
  close(now);
  stage_ = static_cast<int>(stage);
  since_ = now;
}

void StageTimer::end_step() {
  if (stage_ >= 0) {
    close(Clock::now());
    stage_ = -1;
    ++timed_steps_;
  }
  ++steps_;
}

std::array<double, kStageCount> StageTimer::seconds() const {
  std::array<double, kStageCount> all = timed_seconds_;
  for (double& seconds : all) {
    seconds *= timed_steps_ > 0 ? static_cast<double>(steps_) / static_cast<double>(timed_steps_) : 0.0;
  }
  return all;
}

void StageTimer::close(Clock::time_point now) {
  if (stage_ >= 0)
    timed_seconds_[static_cast<std::size_t>(stage_)] += std::chrono::duration<double>(now - since_).count();
}

}  // namespace cellcrush::worker
