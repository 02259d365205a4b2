#include "rpc/accounts.h"

namespace cellcrush::rpc {
namespace {

constexpr std::int64_t kSmall = 64 * 1024;  // others' large requests do not keep it out

}  // namespace

void Accounts::Charge::set(std::int64_t bytes) {
  const auto by = bytes - std::exchange(bytes_, bytes);
  if (by != 0) accounts_.change(caller_, by);
}

std::shared_ptr<Accounts::Charge> Accounts::take(const std::string& caller, std::int64_t bytes) {
  const MutexLock lock(mutex_);
  const auto found = callers_.find(caller);
  if (found != callers_.end() &&
      (found->second + bytes > most_.per_caller || (bytes > kSmall && in_all_ + bytes > most_.in_all))) {
    is_awaited_ = true;
    return nullptr;
  }
  if (bytes != 0) callers_[caller] += bytes;
  in_all_ += bytes;
  return std::make_shared<Charge>(*this, caller, bytes);
}

void Accounts::change(const std::string& caller, std::int64_t by) {
  bool is_awaited = false;
  {
    const MutexLock lock(mutex_);
    in_all_ += by;
    auto& held = callers_[caller];
    held += by;
    if (held == 0) callers_.erase(caller);
    if (by < 0) is_awaited = std::exchange(is_awaited_, false);
  }
  if (is_awaited) {
    for (const auto& call : on_release_) call();
  }
}

ServiceError too_many_bytes(const std::string& caller) {
  return {ServiceError::Kind::exhausted, "The requests of " + caller +
                                             " that wait to be answered hold too many bytes. Send fewer large requests "
                                             "at once, and try again later."};
}

}  // namespace cellcrush::rpc
