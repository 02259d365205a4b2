#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/sweeps_service.pb.h"
#include "terminal/progress_text.h"

namespace cellcrush::client {

/// What is known of a sweep and its jobs while it is watched.
class SweepView {
 public:
  struct Entry {
    std::string name;
    JobView view;

    /// PENDING while nothing has come of it.
    [[nodiscard]] v1::JobState state() const;
  };

  void apply(const v1::WatchSweepResponse& response);

  [[nodiscard]] const v1::Sweep& sweep() const { return sweep_; }
  /// Its jobs, in the order of the sweep.
  [[nodiscard]] const std::vector<Entry>& jobs() const { return jobs_; }
  [[nodiscard]] int count(v1::JobState state) const;
  /// Jobs that will change no more.
  [[nodiscard]] int count_ended() const;

  /// Share of the whole sweep that is done: the mean over its jobs, an ended one counted as done.
  [[nodiscard]] double fraction() const;
  /// Seconds until the last job ends, at the pace of those that run and for those that wait at the mean of the others;
  /// nothing while none runs.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  Entry& find_entry(const std::string& name);

  v1::Sweep sweep_;
  std::vector<Entry> jobs_;
};

}  // namespace cellcrush::client
