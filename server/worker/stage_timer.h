#pragma once

#include <array>
#include <cstdint>
#include <ctime>

#include "cellcrush/stage.h"

namespace cellcrush::worker {

/// Processor time, s: CLOCK_THREAD_CPUTIME_ID for this thread, CLOCK_PROCESS_CPUTIME_ID for the process. Other load on
/// the machine is not included.
inline double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Processor time of a run by stage, sampled: reading the clock takes about 200 ns, which would slow the steps of a
/// small lattice. A run that advances in pieces passes the same timer each time. Not thread-safe; it times the thread
/// that advances.
class StageTimer : public StageObserver {
 public:
  /// A prime, so that periodic work is sampled in proportion.
  static constexpr int kInterval = 61;

  /// Times one step in `interval`, at least 1.
  explicit StageTimer(int interval = kInterval) : interval_(interval) {}

  void begin(Stage stage) override;
  void end_step() override;

  /// Adds the times of an earlier part of the run, s, in the order of kStageNames.
  void set_earlier(const std::array<double, kStageCount>& seconds) { earlier_seconds_ = seconds; }

  /// Time in each stage over all steps so far, s, in the order of kStageNames. Steps not sampled count with the mean of
  /// the sampled ones. All 0 before the first step.
  [[nodiscard]] std::array<double, kStageCount> seconds() const;

 private:
  void close(double now);

  int interval_;
  std::int64_t steps_ = 0;
  std::int64_t timed_steps_ = 0;
  int stage_ = -1;      ///< stage being timed; -1: none
  double since_ = 0.0;  ///< processor time at its start
  std::array<double, kStageCount> timed_seconds_{};
  std::array<double, kStageCount> earlier_seconds_{};
};

}  // namespace cellcrush::worker
