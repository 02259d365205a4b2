#include "watch/recent_events.h"

#include <algorithm>
#include <utility>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::watch {

RecentEvents::Answers& RecentEvents::answers_of(std::int64_t job, std::uint64_t stamp) {
  if (!answers_.contains(job) && answers_.size() >= kMostJobs) {
    answers_.erase(std::min_element(answers_.begin(), answers_.end(), [](const auto& one, const auto& other) {
      return one.second.turn < other.second.turn;
    }));
  }
  Answers& out = answers_[job];
  out.turn = ++turn_;
  if (std::exchange(out.stamp, std::max(out.stamp, stamp)) < stamp) out.events.clear();
  return out;
}

std::vector<RecentEvents::Event> RecentEvents::after(store::JournalReader& journal, std::int64_t job,
                                                     std::int64_t after, std::uint64_t stamp) {
  {
    const MutexLock lock(mutex_);
    const auto& known = answers_of(job, stamp).events;
    if (const auto found = known.find(after); found != known.end()) return found->second;
    ++reads_;
  }
  // Without the lock, as a result may be large.
  std::vector<Event> out;
  std::size_t bytes = 0;
  for (auto& event : journal.events(job, after, kAtOnce)) {
    bytes += event.ByteSizeLong();
    out.push_back(std::make_shared<const v1::JobEvent>(std::move(event)));
  }
  if (out.empty() && !journal.has_job(job))
    throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  const MutexLock lock(mutex_);
  Answers& answers = answers_of(job, stamp);
  if (stamp < answers.stamp || bytes > kMostBytes) return out;
  answers.events.emplace(after, out);
  // That of the watcher that lags most goes first.
  if (answers.events.size() > kMostAnswers) answers.events.erase(answers.events.begin());
  return out;
}

std::int64_t RecentEvents::reads() const {
  const MutexLock lock(mutex_);
  return reads_;
}

}  // namespace cellcrush::watch
