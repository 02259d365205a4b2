#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "cellcrush/v1/sweeps_service.pb.h"
#include "terminal/progress_text.h"

namespace cellcrush::client {

/// State of a watched sweep and its jobs.
class SweepView {
 public:
  struct Entry {
    std::string name;
    JobView view;

    /// PENDING until an event arrives.
    [[nodiscard]] v1::Job::State state() const;
  };

  void apply(const v1::WatchSweepResponse& response);

  [[nodiscard]] const v1::Sweep& sweep() const { return sweep_; }
  /// Its jobs, in the order of the sweep.
  [[nodiscard]] const std::vector<Entry>& jobs() const { return jobs_; }
  [[nodiscard]] int count(v1::Job::State state) const;
  /// Number of jobs in a final state.
  [[nodiscard]] int count_ended() const;
  /// Whether the states of all jobs have arrived.
  [[nodiscard]] bool is_known() const;

  /// Completed share of the sweep: the mean over its jobs, with an ended job counting as complete.
  [[nodiscard]] double fraction() const;
  /// Seconds until the last job ends. Running jobs continue at their pace; waiting ones are assumed to take the mean of
  /// the others. Nothing while none runs.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  Entry& find_entry(const std::string& name);

  v1::Sweep sweep_;
  std::vector<Entry> jobs_;
  std::unordered_map<std::string, std::size_t> places_;  ///< in jobs_, by name
};

/// The lines of the in-place display: the number of ended jobs, a bar with the remaining time of the sweep, then one
/// row per job with its varied values. None is wider than `width`, and there are at most `height`; a larger sweep shows
/// its running jobs first.
std::vector<std::string> sweep_progress_lines(const SweepView& view, int width, int height, const Terminal& terminal);

/// The same in one line of any width, for a log.
std::string sweep_progress_line(const SweepView& view);

}  // namespace cellcrush::client
