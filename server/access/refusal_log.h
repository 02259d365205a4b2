#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace cellcrush::access {

/// Warns of refused calls in the log, at most once a second, so that whoever tries again and again does not fill it. Those
/// between two lines are counted in the later one, or at the end. Thread-safe.
class RefusalLog {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RefusalLog(std::function<Clock::time_point()> now = Clock::now);
  ~RefusalLog();
  RefusalLog(const RefusalLog&) = delete;
  RefusalLog& operator=(const RefusalLog&) = delete;

  /// `words` are the status, what was refused and why, and hold no secret.
  void note(const std::string& words);

 private:
  std::function<Clock::time_point()> now_;
  std::mutex mutex_;
  std::optional<Clock::time_point> last_line_;
  int left_out_ = 0;  ///< since the last line
};

}  // namespace cellcrush::access
