#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

namespace cellcrush::rpc {

/// Lets one large case at a time be built for a check: the mesh of two million elements takes some 900 MB and two
/// seconds, and whoever asks for many of them is not to take the daemon's memory. Thread-safe.
class LargeChecks {
 public:
  /// The place of the one that is being built, given back when this goes away.
  class Place {
   public:
    /// Waits for it. Throws ServiceError: exhausted when it is not free within some seconds, and what `look_up` throws,
    /// which is called several times a second.
    Place(LargeChecks& checks, const std::function<void()>& look_up);
    ~Place();
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    LargeChecks& checks_;
  };

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool taken_ = false;
};

}  // namespace cellcrush::rpc
