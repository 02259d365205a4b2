#include "rpc/stream_limits.h"

#include <fmt/format.h>

#include "error.h"

namespace cellcrush::rpc {
namespace {

std::string limit_of(const std::string& option, const char* end) {
  return option.empty() ? "the limit" : "the limit of " + option + end;
}

}  // namespace

StreamLimits::Permit::~Permit() {
  if (limits_ == nullptr) return;
  const MutexLock lock(limits_->mutex_);
  limits_->bytes_ -= bytes_;
  --limits_->count_;
  const auto caller = limits_->callers_.find(caller_);
  if (--caller->second == 0) limits_->callers_.erase(caller);
}

void StreamLimits::Permit::hold(std::size_t bytes) {
  if (limits_ == nullptr) return;
  const MutexLock lock(limits_->mutex_);
  limits_->bytes_ -= std::exchange(bytes_, 0);
  const auto wanted = static_cast<std::int64_t>(bytes);
  // A single stream may always hold its message.
  if (limits_->bytes_ > 0 && limits_->bytes_ + wanted > limits_->most_.bytes) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       "Open streams hold " + std::to_string(limits_->bytes_) +
                           " bytes not yet read by their clients, the limit of --max-call-memory. Try again later, and "
                           "read streams without delay.");
  }
  limits_->bytes_ += bytes_ = wanted;
}

StreamLimits::Permit StreamLimits::admit(const std::string& caller) {
  const MutexLock lock(mutex_);
  if (count_ >= most_.in_all) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       fmt::format("{} {} are open, {}. Try again later, and close {} that are not read.", count_,
                                   most_.what, limit_of(most_.option, ""), most_.what));
  }
  int& of_caller = callers_[caller];
  if (of_caller >= most_.per_caller) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       fmt::format("{} has {} {} open, {}. Close some first.", caller, of_caller, most_.what,
                                   limit_of(most_.option, "-per-caller")));
  }
  ++of_caller;
  ++count_;
  return {*this, caller};
}

std::size_t StreamLimits::count() const {
  const MutexLock lock(mutex_);
  return static_cast<std::size_t>(count_);
}

}  // namespace cellcrush::rpc
