#include "worker/progress_meter.h"

#include <algorithm>

namespace cellcrush::worker {
namespace {

constexpr std::chrono::milliseconds kInterval{200};
constexpr double kNewShare = 0.3;  // weight of the newest reading of the speed

}  // namespace

ProgressMeter::ProgressMeter(std::int64_t step_count, double plateau_low, double plateau_high, Clock::time_point start,
                             std::int64_t first_step)
    : step_count_(step_count),
      plateau_low_(plateau_low),
      plateau_high_(plateau_high),
      last_time_(start),
      last_step_(first_step) {}

void ProgressMeter::add(const v1::Sample& sample) {
  // A sample's stress is the mean since the sample before it.
  const double from = std::clamp(newest_.strain(), plateau_low_, plateau_high_);
  const double to = std::clamp(sample.strain(), plateau_low_, plateau_high_);
  plateau_integral_ += sample.stress_impact_mpa() * (to - from);
  plateau_width_ += to - from;
  newest_ = sample;
}

std::optional<v1::Progress> ProgressMeter::read(std::int64_t step, double strain, Clock::time_point now) {
  if (now - last_time_ < kInterval) return std::nullopt;
  const double seconds = std::chrono::duration<double>(now - last_time_).count();
  const double speed = static_cast<double>(step - last_step_) / seconds;
  steps_per_second_ = steps_per_second_ > 0.0 ? (1.0 - kNewShare) * steps_per_second_ + kNewShare * speed : speed;
  last_time_ = now;
  last_step_ = step;

  v1::Progress out;
  out.set_strain(strain);
  out.set_step(step);
  out.set_step_count(step_count_);
  out.set_steps_per_second(steps_per_second_);
  if (steps_per_second_ > 0.0) out.set_seconds_left(static_cast<double>(step_count_ - step) / steps_per_second_);
  if (plateau_width_ > 0.0) out.set_plateau_so_far_mpa(plateau_integral_ / plateau_width_);
  if (step_count_ > 0) out.set_fraction(static_cast<double>(step) / static_cast<double>(step_count_));
  out.set_stress_impact_mpa(newest_.stress_impact_mpa());
  out.set_stress_support_mpa(newest_.stress_support_mpa());
  return out;
}

}  // namespace cellcrush::worker
