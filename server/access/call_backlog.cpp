#include "access/call_backlog.h"

#include <algorithm>
#include <utility>

namespace cellcrush::access {
namespace {

constexpr std::size_t kFlood = 200;  // refused calls
constexpr std::chrono::seconds kBetweenCounts{1};
constexpr std::chrono::milliseconds kSlow{100};  // for a message to come

}  // namespace

bool CallBacklog::admit(Key connection) {
  std::string flood;
  bool is_crowd = false;
  bool has_place = false;
  {
    const MutexLock lock(mutex_);
    auto& of = connections_[connection];
    has_place = of.coming + of.begun + coming_ + begun_ < most_;
    if (has_place) {
      ++of.coming;
      ++coming_;
    } else {
      ++refusals_;
      if (++of.refusals % kFlood == 0) flood = of.name;
    }
    is_crowd = find_crowd();
  }
  if (!flood.empty() && alarms_.flood) alarms_.flood(flood);
  if (is_crowd && alarms_.crowd) alarms_.crowd();
  return has_place;
}

void CallBacklog::look() {
  bool is_crowd = false;
  {
    const MutexLock lock(mutex_);
    is_crowd = find_crowd();
  }
  if (is_crowd && alarms_.crowd) alarms_.crowd();
}

bool CallBacklog::find_crowd() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ >= kSlow) {
    slow_ = before_ - std::min(before_, queued_since_);
    before_ = coming_ - queued_;
    queued_since_ = 0;
    last_look_ = now;
  }
  if (is_settling_ || now < may_settle_) return false;
  is_settling_ = coming_ - queued_ >= crowd() || slow_ >= slow_crowd();
  return is_settling_;
}

void CallBacklog::queue() {
  const MutexLock lock(mutex_);
  ++queued_;
  ++queued_since_;
  coming_ = std::max(coming_, queued_);
}

void CallBacklog::begin(Key connection, const std::string& name) {
  const MutexLock lock(mutex_);
  auto& of = connections_[connection];
  of.name = name;
  ++of.begun;
  ++begun_;
  if (of.coming > 0) --of.coming;
  --coming_;
  if (--queued_ > 0 || refusals_ == 0) return;
  refusals_ = 0;
  for (auto& [key, each] : connections_) each.refusals = 0;
}

void CallBacklog::end(Key connection) {
  const MutexLock lock(mutex_);
  --begun_;
  const auto of = connections_.find(connection);
  if (--of->second.begun == 0 && of->second.coming == 0) connections_.erase(of);
}

std::vector<std::string> CallBacklog::settle(const std::map<std::string, std::size_t>& streams) {
  auto held = streams;
  const MutexLock lock(mutex_);
  for (auto& [key, each] : connections_) {
    each.coming = 0;
    if (const auto found = held.find(each.name); found != held.end())
      found->second -= std::min(found->second, each.begun);
  }
  std::erase_if(connections_, [](const auto& each) { return each.second.begun == 0; });
  std::size_t all = 0;
  std::vector<std::pair<std::size_t, std::string>> most_first;
  for (const auto& [name, count] : held) {
    all += count;
    most_first.emplace_back(count, name);
  }
  auto most = crowd();
  if (all < most && slow_ >= slow_crowd()) {
    // A connection may have many calls for a moment: what counts is what it had before as well.
    most = slow_crowd();
    for (auto& [count, name] : most_first) count = std::min(count, held_[name]);
  }
  std::sort(most_first.rbegin(), most_first.rend());
  std::vector<std::string> out;
  for (const auto& [count, name] : most_first) {
    if (all < most || count == 0) break;
    if (!name.starts_with("ipv")) continue;  // one name for all connections of Unix sockets
    out.push_back(name);
    all -= count;
  }
  held_ = std::move(held);
  coming_ = std::max(all, queued_);
  is_settling_ = false;
  if (all >= crowd()) may_settle_ = std::chrono::steady_clock::now() + kBetweenCounts;
  if (all < crowd() && all >= slow_crowd()) may_settle_ = std::chrono::steady_clock::now() + kSlow;
  return out;
}

}  // namespace cellcrush::access
