#include "rpc/large_checks.h"

#include <chrono>

#include "error.h"

namespace cellcrush::rpc {
namespace {

constexpr int kLooks = 100;
constexpr std::chrono::milliseconds kBetweenLooks{100};

}  // namespace

LargeChecks::Place::Place(LargeChecks& checks, const std::function<void()>& look_up) : checks_(checks) {
  for (int i = 0; i < kLooks; ++i) {
    look_up();
    std::unique_lock lock(checks_.mutex_);
    if (checks_.changed_.wait_for(lock, kBetweenLooks, [this] { return !checks_.taken_; })) {
      checks_.taken_ = true;
      return;
    }
  }
  throw ServiceError(ServiceError::Kind::exhausted,
                     "Other large cases are being checked, one at a time. Try again in a few seconds.");
}

LargeChecks::Place::~Place() {
  {
    const std::scoped_lock lock(checks_.mutex_);
    checks_.taken_ = false;
  }
  checks_.changed_.notify_one();
}

}  // namespace cellcrush::rpc
