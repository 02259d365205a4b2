#include "terminal/sweep_view.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>

#include "exit_code.h"

namespace cellcrush::client {

namespace {

using google::protobuf::util::TimeUtil;
using Entry = SweepView::Entry;

// Estimated total seconds of a job; nothing for a waiting one.
std::optional<double> duration_of(const Entry& entry) {
  const v1::Job& job = entry.view.job();
  if (job.has_start_time() && job.has_end_time()) {
    return 1e-3 * static_cast<double>(TimeUtil::DurationToMilliseconds(job.end_time() - job.start_time()));
  }
  const v1::Progress& progress = job.progress();
  if (progress.steps_per_second() <= 0.0 || progress.step_count() <= 0) return std::nullopt;
  return static_cast<double>(progress.step_count()) / progress.steps_per_second();
}

}  // namespace

v1::Job::State SweepView::Entry::state() const {
  const v1::Job::State state = view.job().state();
  return state == v1::Job::JOB_STATE_UNSPECIFIED ? v1::Job::PENDING : state;
}

void SweepView::apply(const v1::WatchSweepResponse& response) {
  if (response.has_snapshot()) {
    sweep_ = response.snapshot();
    for (const std::string& name : sweep_.jobs()) find_entry(name);
  }
  if (!response.job().empty()) find_entry(response.job()).view.apply(response.event());
}

int SweepView::count(v1::Job::State state) const {
  return static_cast<int>(
      std::count_if(jobs_.begin(), jobs_.end(), [&](const Entry& entry) { return entry.state() == state; }));
}

int SweepView::count_ended() const {
  return count(v1::Job::SUCCEEDED) + count(v1::Job::FAILED) + count(v1::Job::CANCELLED);
}

double SweepView::fraction() const {
  double done = 0.0;
  for (const Entry& entry : jobs_) done += is_final(entry.state()) ? 1.0 : entry.view.progress().fraction();
  return jobs_.empty() ? 0.0 : done / static_cast<double>(jobs_.size());
}

std::optional<double> SweepView::seconds_left() const {
  double known = 0.0;
  double left = 0.0;
  double longest = 0.0;
  int known_count = 0;
  for (const Entry& entry : jobs_) {
    if (const auto duration = duration_of(entry)) {
      known += *duration;
      ++known_count;
    }
    if (entry.state() != v1::Job::RUNNING) continue;
    left += entry.view.progress().seconds_left();
    longest = std::max(longest, entry.view.progress().seconds_left());
  }
  const int running = count(v1::Job::RUNNING);
  if (running == 0 || known_count == 0) return std::nullopt;
  left += known / known_count * count(v1::Job::PENDING);
  return std::max(left / running, longest);
}

SweepView::Entry& SweepView::find_entry(const std::string& name) {
  const auto [place, is_new] = places_.try_emplace(name, jobs_.size());
  return is_new ? jobs_.emplace_back(Entry{name, {}}) : jobs_[place->second];
}

}  // namespace cellcrush::client
