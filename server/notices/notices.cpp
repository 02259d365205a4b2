#include "notices/notices.h"

#include <algorithm>
#include <utility>

namespace cellcrush::notices {

Notices::Notices(const Parts& parts, const Options& options) : parts_(parts) {
  for (auto& receiver : make_receivers(options, parts_.epoch, parts_.reader)) {
    const Courier::Parts of_courier{
        parts_.journal, {parts_.changes, parts_.reader, parts_.sweeps, parts_.epoch}, parts_.metrics, options};
    couriers_.push_back(std::make_unique<Courier>(of_courier, std::move(receiver)));
  }
}

void Notices::start() {
  for (const auto& courier : couriers_) courier->start();
}

void Notices::stop() {
  for (const auto& courier : couriers_) courier->stop();
}

void Notices::set_standings(const std::vector<jobs::Queues::Standing>& standings) {
  if (couriers_.empty()) return;
  std::vector<Notice> news;
  {
    const MutexLock lock(mutex_);
    for (const auto& standing : standings) {
      const jobs::Hold* hold = standing.holds.empty() ? nullptr : &standing.holds.front();
      const Shortage now = hold != nullptr ? hold->shortage : Shortage::none;
      if (std::exchange(held_[standing.executor], now) != now)
        news.push_back(notice_of_queue(parts_.epoch, standing.executor, hold));
    }
  }
  for (const auto& notice : news) {
    for (const auto& courier : couriers_) courier->post(notice);
  }
}

std::map<std::string, std::int64_t> Notices::behind() {
  std::map<std::string, std::int64_t> out;
  if (couriers_.empty()) return out;
  const std::int64_t last = parts_.changes.last();
  for (const auto& courier : couriers_) out[courier->name()] += std::max<std::int64_t>(0, last - courier->position());
  return out;
}

}  // namespace cellcrush::notices
