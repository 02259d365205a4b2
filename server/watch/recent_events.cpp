#include "watch/recent_events.h"

#include <algorithm>
#include <utility>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::watch {
namespace {

std::vector<RecentEvents::Event> read_events(store::JournalReader& journal, std::int64_t job, std::int64_t after) {
  std::vector<RecentEvents::Event> out;
  for (auto& event : journal.events(job, after, RecentEvents::kAtOnce))
    out.push_back(std::make_shared<const v1::JobEvent>(std::move(event)));
  if (out.empty() && !journal.has_job(job))
    throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  return out;
}

}  // namespace

// A job that begins again drops the samples before.
void RecentEvents::Tail::add(const Event& event) {
  if (event->has_state() && event->state().begun_again_sequence() == event->sequence()) {
    events.clear();
    bytes = 0;
    begin = event->sequence() - 1;
  }
  events.push_back(event);
  bytes += event->ByteSizeLong();
  while (events.size() > kAtOnce || bytes > kMostBytes) drop_first();
}

void RecentEvents::Tail::drop_first() {
  begin = events.front()->sequence();
  bytes -= events.front()->ByteSizeLong();
  events.pop_front();
}

// A watcher ahead of the tail begins another one.
RecentEvents::Tail& RecentEvents::tail_of(std::int64_t job, std::int64_t after) {
  auto found = tails_.find(job);
  if (found == tails_.end()) {
    if (tails_.size() >= kMostJobs) {
      tails_.erase(std::min_element(tails_.begin(), tails_.end(), [](const auto& one, const auto& other) {
        return one.second.turn < other.second.turn;
      }));
    }
    found = tails_.try_emplace(job).first;
    found->second.begin = after;
  } else if (after > found->second.end()) {
    found->second = Tail();
    found->second.begin = after;
  }
  found->second.turn = ++turn_;
  return found->second;
}

std::vector<RecentEvents::Event> RecentEvents::look_behind(store::JournalReader& journal, std::int64_t job, Tail& tail,
                                                           std::uint64_t stamp) {
  ++reads_;
  try {
    auto out = read_events(journal, job, tail.end());
    tail.stamp = stamp;
    // An unreadable event ends what is read; only a look behind it can say so.
    tail.is_complete = out.empty();
    for (const auto& event : out) tail.add(event);
    return out;
  } catch (const ServiceError&) {
    tails_.erase(job);
    throw;
  }
}

std::vector<RecentEvents::Event> RecentEvents::after(store::JournalReader& journal, std::int64_t job,
                                                     std::int64_t after, std::uint64_t stamp) {
  MutexLock lock(mutex_);
  Tail& tail = tail_of(job, after);
  const bool is_up_to_date = tail.is_complete && tail.stamp == stamp;
  // The job may have begun again, which drops samples.
  if (after >= tail.begin && after < tail.end() && !is_up_to_date) look_behind(journal, job, tail, stamp);
  if (after < tail.begin) {
    ++reads_;
    lock.unlock();
    return read_events(journal, job, after);
  }
  if (after < tail.end()) {
    const auto first =
        std::upper_bound(tail.events.begin(), tail.events.end(), after,
                         [](std::int64_t sequence, const Event& event) { return sequence < event->sequence(); });
    return {first, tail.events.end()};
  }
  return is_up_to_date ? std::vector<Event>() : look_behind(journal, job, tail, stamp);
}

std::int64_t RecentEvents::reads() const {
  const MutexLock lock(mutex_);
  return reads_;
}

}  // namespace cellcrush::watch
