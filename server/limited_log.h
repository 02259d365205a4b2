#pragma once

#include <spdlog/common.h>

#include <chrono>
#include <functional>
#include <string>

#include "mutex.h"

namespace cellcrush {

/// Log lines of one kind, limited per second so that a caller who provokes them cannot fill the log. The next line, or
/// the destructor, reports the number omitted. Thread-safe.
class LimitedLog {
 public:
  using Clock = std::chrono::steady_clock;

  /// `kind` names the lines in the final count: "refused calls".
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
  Clock::time_point second_ CELLCRUSH_GUARDED_BY(mutex_);  ///< start of the second that lines_ counts
  int lines_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  int left_out_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< omitted since the last line
};

/// Routes the logs of gRPC and protobuf to the default logger until the process ends. At most 10 lines a second of 500
/// bytes each are logged, and a later line counts the omitted ones. Lines may contain bytes from a caller. Thread-safe.
void redirect_library_logs();

}  // namespace cellcrush
