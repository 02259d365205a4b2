#include "jobs/queue_hold.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace cellcrush::jobs {

QueueHold::QueueHold(const HoldTimes& times, Changed changed, Now now, std::string queue)
    : queue_(std::move(queue)), times_(times), changed_(std::move(changed)), now_(std::move(now)) {}

bool QueueHold::set_low_disk(const std::optional<std::string>& reason) {
  {
    const MutexLock lock(mutex_);
    if (low_disk_.has_value() == reason.has_value()) return false;
    low_disk_ = reason ? std::optional(Hold{Shortage::low_disk, *reason, now_(), {}}) : std::nullopt;
  }
  reason ? spdlog::warn("{} is held: {} {}", queue_, *reason, remedy_for(Shortage::low_disk))
         : spdlog::info("{} is no longer held for low disk space", queue_);
  tell();
  return true;
}

bool QueueHold::is_open() const {
  const MutexLock lock(mutex_);
  if (low_disk_) return false;
  return !trouble_ || (!trial_ && now_() >= *trouble_->next_try);
}

bool QueueHold::begin_start() {
  const MutexLock lock(mutex_);
  trial_ = trouble_.has_value();
  return trial_;
}

void QueueHold::succeeded() {
  {
    const MutexLock lock(mutex_);
    trial_ = false;
    if (!trouble_) return;
    spdlog::info("{} is released: the shortage is over ({})", queue_, name_of(trouble_->shortage));
    trouble_.reset();
    over_ = now_();
  }
  tell();
}

void QueueHold::proven() {
  const MutexLock lock(mutex_);
  if (!trouble_) pause_ = std::chrono::milliseconds(0);
}

void QueueHold::try_now(Shortage shortage) {
  {
    const MutexLock lock(mutex_);
    if (!trouble_ || trouble_->shortage != shortage || trial_ || *trouble_->next_try <= now_()) return;
    trouble_->next_try = now_();
  }
  tell();
}

void QueueHold::failed(const Trouble& trouble) {
  {
    const MutexLock lock(mutex_);
    const auto now = now_();
    const bool is_same = trouble_ && trouble_->shortage == trouble.shortage;
    // Slots that meet it together with the trial, or before it, count as one try.
    if (is_same && !trial_) return;
    // A trouble that soon returns was not over.
    const bool goes_on = trouble_ || now - over_ < pause_;
    pause_ = goes_on ? std::clamp(2 * pause_, times_.first, times_.longest) : times_.first;
    trial_ = false;
    const auto since = trouble_ ? trouble_->since : now;
    if (!is_same) spdlog::warn("{} is held: {} {}", queue_, trouble.reason, remedy_for(trouble.shortage));
    trouble_.emplace(Hold{trouble.shortage, trouble.reason, since, now + pause_});
  }
  tell();
}

void QueueHold::end_trial() {
  const MutexLock lock(mutex_);
  trial_ = false;
}

std::optional<Hold::Clock::time_point> QueueHold::next_try() const {
  const MutexLock lock(mutex_);
  return trouble_ && !low_disk_ && !trial_ ? trouble_->next_try : std::nullopt;
}

std::vector<Hold> QueueHold::holds() const {
  const MutexLock lock(mutex_);
  std::vector<Hold> out;
  for (const auto& hold : {low_disk_, trouble_}) {
    if (hold) out.push_back(*hold);
  }
  return out;
}

void QueueHold::tell() {
  const MutexLock lock(telling_);
  if (changed_) changed_(holds());
}

}  // namespace cellcrush::jobs
