#include "notices/courier.h"

#include <absl/strings/numbers.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "pause.h"

namespace cellcrush::notices {
namespace {

constexpr std::size_t kMostPosted = 64;
constexpr std::chrono::milliseconds kBetweenLooks{500};  // at the journal
constexpr std::chrono::seconds kBetweenKeeping{2};
constexpr std::chrono::milliseconds kLongestPause{300'000};

}  // namespace

Courier::Courier(Parts parts, std::unique_ptr<Receiver> receiver)
    : parts_(std::move(parts)), receiver_(std::move(receiver)) {
  using Result = metrics::Metrics::Notice;
  for (const Result result : {Result::delivered, Result::retried, Result::dropped})
    parts_.metrics.count_notices(receiver_->name(), result, 0);
}

void Courier::start() {
  position_ = find_position();
  feed_.emplace(parts_.feed, position_, [this](const std::string& type) { return receiver_->wants(type); });
  spdlog::info("notices go to {}", receiver_->name());
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Courier::stop() { thread_ = {}; }

void Courier::post(const Notice& notice) {
  if (!receiver_->wants(notice.type)) return;
  {
    const MutexLock lock(mutex_);
    posted_.push_back(notice);
    if (posted_.size() > kMostPosted) {
      posted_.pop_front();
      parts_.metrics.count_notices(receiver_->name(), metrics::Metrics::Notice::dropped, 1);
    }
  }
  changed_.notify_all();
}

// A receiver that is new hears of nothing that was before.
std::int64_t Courier::find_position() {
  auto& changes = parts_.feed.changes;
  const std::int64_t last = changes.last();
  std::int64_t out = 0;
  if (!absl::SimpleAtoi(changes.fact(receiver_->key()), &out) || out > last) return last;
  kept_ = out;
  return out;
}

void Courier::work(const std::stop_token& stop) {
  std::string logged;
  keep_position();
  while (!stop.stop_requested()) {
    try {
      send_all(stop);
      logged.clear();
    } catch (const std::exception& error) {
      if (std::exchange(logged, error.what()) != error.what())
        spdlog::warn("Notices to {} wait: {}", receiver_->name(), error.what());
    }
    keep_position(kBetweenKeeping);
    MutexLock lock(mutex_);
    changed_.wait_for(lock, stop, kBetweenLooks, [this]() CELLCRUSH_REQUIRES(mutex_) { return !posted_.empty(); });
  }
  keep_position();
}

void Courier::send_all(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (const auto notice = take_posted()) {
      send(*notice, stop);
      continue;
    }
    const auto notices = feed_->next(stop);
    if (feed_->has_missed()) {
      spdlog::error("Notices to {} were not sent for so long that the journal has dropped changes: some are lost.",
                    receiver_->name());
      parts_.metrics.count_notices(receiver_->name(), metrics::Metrics::Notice::dropped, 1);
    }
    for (const auto& notice : notices) {
      if (!send(notice, stop)) return;
    }
    position_ = feed_->position();
    if (notices.empty()) return;
    keep_position(kBetweenKeeping);
  }
}

bool Courier::send(const Notice& notice, const std::stop_token& stop) {
  using Result = metrics::Metrics::Notice;
  const auto end = Clock::now() + parts_.options.longest;
  auto pause = parts_.options.pause;
  for (bool first = true; !stop.stop_requested(); first = false) {
    std::string why;
    const auto result = receiver_->send(notice, stop, why);
    if (result == Receiver::Result::taken) {
      parts_.metrics.count_notices(receiver_->name(), Result::delivered, 1);
      if (!first) spdlog::info("{} takes notices again", receiver_->name());
      return true;
    }
    if (stop.stop_requested()) return false;
    if (result == Receiver::Result::refused || Clock::now() + pause > end) {
      parts_.metrics.count_notices(receiver_->name(), Result::dropped, 1);
      spdlog::error("The notice {} of {} to {} is dropped: {}", notice.type, notice.resource, receiver_->name(), why);
      return true;
    }
    if (first)
      spdlog::warn("The notice {} of {} to {} is sent again later: {}", notice.type, notice.resource, receiver_->name(),
                   why);
    parts_.metrics.count_notices(receiver_->name(), Result::retried, 1);
    keep_position();
    if (!pause_unless_stopped(stop, pause)) return false;
    pause = std::min(2 * pause, kLongestPause);
  }
  return false;
}

std::optional<Notice> Courier::take_posted() {
  const MutexLock lock(mutex_);
  if (posted_.empty()) return std::nullopt;
  Notice out = std::move(posted_.front());
  posted_.pop_front();
  return out;
}

void Courier::keep_position(std::chrono::milliseconds after) {
  if (position_ == kept_ || Clock::now() - last_kept_ < after) return;
  try {
    const std::int64_t now = position_;
    parts_.journal.set_fact(receiver_->key(), std::to_string(now));
    kept_ = now;
    last_kept_ = Clock::now();
  } catch (const std::exception& error) {
    spdlog::warn("How far {} has been told cannot be kept now: {}", receiver_->name(), error.what());
  }
}

}  // namespace cellcrush::notices
