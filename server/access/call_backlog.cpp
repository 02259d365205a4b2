#include "access/call_backlog.h"

#include <iterator>
#include <utility>

namespace cellcrush::access {
namespace {

constexpr std::size_t kFlood = 100;  // refused calls in a second

}  // namespace

bool CallBacklog::admit(Key connection) {
  std::string flood;
  {
    const MutexLock lock(mutex_);
    auto& of = connections_[connection];
    if (of.coming + of.begun == 0 || of.coming + of.begun + coming_ + begun_ < most_) {
      ++of.coming;
      ++coming_;
      return true;
    }
    flood = count_refusal(of);
  }
  if (!flood.empty() && on_flood_) on_flood_(flood);
  return false;
}

void CallBacklog::refuse(Key connection) {
  std::string flood;
  {
    const MutexLock lock(mutex_);
    flood = count_refusal(connections_[connection]);
  }
  if (!flood.empty() && on_flood_) on_flood_(flood);
}

std::string CallBacklog::count_refusal(Connection& of) {
  if (++of.refusals < kFlood || of.name.empty() || std::exchange(of.is_cut, true)) return "";
  return of.name;
}

void CallBacklog::queue() {
  const MutexLock lock(mutex_);
  ++queued_;
}

void CallBacklog::begin(Key connection, const std::string& name) {
  const MutexLock lock(mutex_);
  auto& of = connections_[connection];
  of.name = name;
  ++of.begun;
  ++begun_;
  if (of.coming > 0) {
    --of.coming;
    --coming_;
  }
  if (--queued_ > 0 || coming_ == 0) return;
  // Those that still come were cancelled, or are queued in a moment.
  coming_ = 0;
  for (auto& [key, each] : connections_) each.coming = 0;
}

void CallBacklog::end(Key connection) {
  const MutexLock lock(mutex_);
  --begun_;
  --connections_.at(connection).begun;
}

void CallBacklog::look() {
  const MutexLock lock(mutex_);
  for (auto each = connections_.begin(); each != connections_.end();) {
    auto& of = each->second;
    of.refusals = 0;
    each = of.begun + of.coming == 0 ? connections_.erase(each) : std::next(each);
  }
}

}  // namespace cellcrush::access
