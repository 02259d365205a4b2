#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::worker {

/// Progress and speed of a run, at most five times a second. The caller supplies the time. Not thread-safe.
class ProgressMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// `plateau_low`, `plateau_high`: strains between which the plateau stress is averaged. The run starts or resumes at
  /// `first_step`.
  ProgressMeter(std::int64_t step_count, double plateau_low, double plateau_high, Clock::time_point start,
                std::int64_t first_step = 0);

  void add(const v1::Sample& sample);

  /// The progress at `step`, if enough time has passed since the last one.
  std::optional<v1::Progress> read(std::int64_t step, double strain, Clock::time_point now);

 private:
  std::int64_t step_count_;
  double plateau_low_;
  double plateau_high_;
  Clock::time_point last_time_;
  std::int64_t last_step_ = 0;
  double steps_per_second_ = 0.0;  ///< smoothed over the last few readings
  v1::Sample newest_;
  double plateau_integral_ = 0.0;  ///< impact stress over strain, within the window
  double plateau_width_ = 0.0;     ///< strain within the window so far
};

}  // namespace cellcrush::worker
