#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

#include "jobs/child.h"

namespace cellcrush::jobs {

/// Hands the wish to cancel on to a worker: closes the daemon's direction of its socket, and ends the worker when it has
/// not acknowledged that within 2 s, or not ended within 60 s. Lives while the worker talks; the worker is not waited for
/// meanwhile.
class Cancellation {
 public:
  Cancellation(int socket, const Child& child, const std::stop_token& wish);
  Cancellation(const Cancellation&) = delete;
  Cancellation& operator=(const Cancellation&) = delete;

  /// The worker has seen the wish and closes its result.
  void acknowledged();

 private:
  void begin();
  void enforce(const std::stop_token& ended);

  int socket_;
  const Child& child_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool acknowledged_ = false;
  std::jthread limit_;  ///< runs once there is the wish; outlived by all above, outlives the callback below
  std::stop_callback<std::function<void()>> on_wish_;
};

}  // namespace cellcrush::jobs
