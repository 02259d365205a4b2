#pragma once

#include <spdlog/common.h>

#include <chrono>
#include <functional>
#include <string>

#include "mutex.h"

namespace cellcrush {

/// Lines of one kind in the log, at most so many a second, so that a caller who provokes them cannot fill it. Those
/// left out are counted in the next line, or at the end. Thread-safe.
class LimitedLog {
 public:
  using Clock = std::chrono::steady_clock;

  /// `kind` names the lines in the count at the end: "refused calls".
  LimitedLog(std::string kind, int lines_per_second, std::function<Clock::time_point()> now = Clock::now);
  ~LimitedLog();
  LimitedLog(const LimitedLog&) = delete;
  LimitedLog& operator=(const LimitedLog&) = delete;

  void write(spdlog::level::level_enum level, const std::string& words);

 private:
  std::string kind_;
  int lines_per_second_;
  std::function<Clock::time_point()> now_;
  Mutex mutex_;
  Clock::time_point second_ CELLCRUSH_GUARDED_BY(mutex_);  ///< begin of the second that lines_ counts
  int lines_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  int left_out_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< since the last line
};

}  // namespace cellcrush
