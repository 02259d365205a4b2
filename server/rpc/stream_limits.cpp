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
  const auto caller = limits_->callers_.find(caller_);
  for (Held* held : {&limits_->all_, &caller->second}) {
    held->bytes -= bytes_;
    --held->count;
  }
  if (caller->second.count == 0) limits_->callers_.erase(caller);
}

void StreamLimits::Permit::hold(std::size_t bytes) {
  if (limits_ == nullptr) return;
  const MutexLock lock(limits_->mutex_);
  Held& all = limits_->all_;
  Held& own = limits_->callers_.at(caller_);
  all.bytes -= bytes_;
  own.bytes -= std::exchange(bytes_, 0);
  const auto wanted = static_cast<std::int64_t>(bytes);
  // A single stream may always hold its message.
  const bool is_own = own.bytes > 0 && own.bytes + wanted > limits_->most_.bytes / 2;
  if (is_own || (all.bytes > 0 && all.bytes + wanted > limits_->most_.bytes)) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       fmt::format("Open streams{} hold {} bytes not yet read by their clients, the limit of "
                                   "--max-call-memory{}. Try again later, and read streams without delay.",
                                   is_own ? " of " + caller_ : "", is_own ? own.bytes : all.bytes,
                                   is_own ? " for one caller" : ""));
  }
  bytes_ = wanted;
  all.bytes += wanted;
  own.bytes += wanted;
}

StreamLimits::Permit StreamLimits::admit(const std::string& caller) {
  const MutexLock lock(mutex_);
  if (all_.count >= most_.in_all) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       fmt::format("{} {} are open, {}. Try again later, and close {} that are not read.",
                                   all_.count, most_.what, limit_of(most_.option, ""), most_.what));
  }
  const auto found = callers_.find(caller);
  const int of_caller = found == callers_.end() ? 0 : found->second.count;
  if (of_caller >= most_.per_caller) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       fmt::format("{} has {} {} open, {}. Close some first.", caller, of_caller, most_.what,
                                   limit_of(most_.option, "-per-caller")));
  }
  ++callers_[caller].count;
  ++all_.count;
  return {*this, caller};
}

std::size_t StreamLimits::count() const {
  const MutexLock lock(mutex_);
  return static_cast<std::size_t>(all_.count);
}

bool StreamLimits::is_short() const {
  const MutexLock lock(mutex_);
  return all_.count >= most_.in_all - most_.in_all / 8 || all_.bytes >= most_.bytes - most_.bytes / 8;
}

}  // namespace cellcrush::rpc
