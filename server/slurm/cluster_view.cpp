#include "slurm/cluster_view.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <vector>

namespace cellcrush::slurm {
namespace {

constexpr std::chrono::milliseconds kBetweenRefreshes{2'000};
// Tasks of which nobody has heard for so many answers are forgotten.
constexpr std::uint64_t kRemembered = 2'000;

}  // namespace

ClusterView::ClusterView(const Commands& commands, std::chrono::milliseconds interval)
    : commands_(commands), interval_(interval), thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::optional<ClusterView::Seen> ClusterView::find(std::int64_t job, int task, const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = tasks_.find({job, task});
  if (found == tasks_.end() || found->second.report.name != name) return std::nullopt;
  return found->second;
}

std::optional<std::int64_t> ClusterView::find_job(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = std::ranges::find(tasks_, name, [](const auto& each) { return each.second.report.name; });
  return found == tasks_.end() ? std::nullopt : std::optional(found->first.first);
}

std::uint64_t ClusterView::answer_count() {
  const MutexLock lock(mutex_);
  return answers_;
}

std::string ClusterView::trouble() {
  const MutexLock lock(mutex_);
  return trouble_;
}

void ClusterView::refresh(std::int64_t missed_job) {
  {
    const MutexLock lock(mutex_);
    is_wanted_ = true;
    if (missed_job != 0) missed_.insert(missed_job);
  }
  changed_.notify_all();
}

void ClusterView::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::set<std::int64_t> missed;
    {
      const MutexLock lock(mutex_);
      is_wanted_ = false;
      missed.swap(missed_);
    }
    look(missed);
    const auto now = std::chrono::steady_clock::now();
    MutexLock lock(mutex_);
    changed_.wait_until(lock, stop, now + std::min(interval_, kBetweenRefreshes), [] { return false; });
    changed_.wait_until(lock, stop, now + interval_, [this]() CELLCRUSH_REQUIRES(mutex_) { return is_wanted_; });
  }
}

void ClusterView::look(const std::set<std::int64_t>& missed) {
  std::string why;
  const auto listed = commands_.squeue(kJobPrefix, why);
  const auto accounted = missed.empty() ? std::nullopt : commands_.sacct({missed.begin(), missed.end()});
  const MutexLock lock(mutex_);
  if (why != trouble_) {
    if (!why.empty()) spdlog::warn("The state of the Slurm jobs is not known at the moment: {}", why);
    trouble_ = why;
  }
  if (listed) {
    // The number of this answer is beyond that of all moments before it was asked for, and not beyond later ones:
    // whoever asks meanwhile waits for the next.
    ++answers_;
    for (const auto& report : *listed) {
      tasks_[{report.job, report.task}] = {report, answers_, answers_};
    }
  }
  if (accounted) {
    for (const auto& report : *accounted) {
      auto& seen = tasks_[{report.job, report.task}];
      seen = {report, seen.answer, answers_};
    }
  }
  std::erase_if(tasks_, [this](const auto& each)
                            CELLCRUSH_REQUIRES(mutex_) { return each.second.heard + kRemembered < answers_; });
}

}  // namespace cellcrush::slurm
