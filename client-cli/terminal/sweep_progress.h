#pragma once

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
  };

  void apply(const v1::WatchSweepResponse& response);

  [[nodiscard]] const v1::Sweep& sweep() const { return sweep_; }
  /// Its jobs, in the order of the sweep.
  [[nodiscard]] const std::vector<Entry>& jobs() const { return jobs_; }
  [[nodiscard]] int count(v1::JobState state) const;
  /// Jobs that will change no more.
  [[nodiscard]] int count_ended() const;

 private:
  Entry& find_entry(const std::string& name);

  v1::Sweep sweep_;
  std::vector<Entry> jobs_;
};

/// The varied values of a job, such as "speed_m_per_s=50"; empty while its case is not known.
std::string varied_values_text(const v1::Sweep& sweep, const v1::Job& job);

/// The lines of the display that is redrawn in place: how many jobs have ended, then a line a job. None is wider than
/// `width` columns, and there are at most `height`: of a larger sweep the running jobs are shown first.
std::vector<std::string> sweep_progress_lines(const SweepView& view, int width, int height, const Terminal& terminal);

/// The same in one line of any width, for a log.
std::string sweep_progress_line(const SweepView& view);

}  // namespace cellcrush::client
