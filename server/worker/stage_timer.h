#pragma once

#include <array>
#include <cstdint>

#include "cellcrush/stage.h"

namespace cellcrush::worker {

/// Processor time by stage of a run, from every so many-th step: a reading of the clock takes some 200 ns, which the
/// steps of a small lattice would feel. A run that advances in pieces is handed the same timer each time. Not
/// thread-safe; the thread that advances is the one that is timed.
class StageTimer : public StageObserver {
 public:
  /// A prime: what recurs every so many steps is caught as often as it is due.
  static constexpr int kInterval = 61;

  /// Looks at one step in `interval`, at least 1.
  explicit StageTimer(int interval = kInterval) : interval_(interval) {}

  void begin(Stage stage) override;
  void end_step() override;

  /// What an earlier part of the run took, s, in the order of kStageNames.
  void set_earlier(const std::array<double, kStageCount>& seconds) { earlier_seconds_ = seconds; }

  /// Time in each stage over all steps so far, s, in the order of kStageNames; what was not looked at is taken as the
  /// mean of what was. All 0 before the first step.
  [[nodiscard]] std::array<double, kStageCount> seconds() const;

 private:
  void close(double now);

  int interval_;
  std::int64_t steps_ = 0;
  std::int64_t timed_steps_ = 0;
  int stage_ = -1;      ///< that is being timed; -1: none
  double since_ = 0.0;  ///< processor time at which it began
  std::array<double, kStageCount> timed_seconds_{};
  std::array<double, kStageCount> earlier_seconds_{};
};

}  // namespace cellcrush::worker
