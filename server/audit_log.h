#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "log_format.h"
#include "mutex.h"
#include "open_file.h"

namespace cellcrush {

/// Who changed what, and whom the daemon refused: a JSON object a line, in a file of its own. monitor.md lists the
/// fields. A change is written before its caller has the answer. Refusals are written by a thread of their own, since
/// who refuses must not wait for a disk: kMostRefusals, and then one a second; the next one counts those left out.
/// Thread-safe.
class AuditLog {
 public:
  static constexpr int kMostRefusals = 20;  ///< at once: whoever provokes them cannot fill the disk

  /// Appends to a file, created for its owner only; an empty path: writes nothing. Throws ServiceError, also for a
  /// pipe.
  explicit AuditLog(std::filesystem::path path);
  ~AuditLog();

  /// Opens the file by its name again, after it was moved away. The old one stays in use if that fails; the log says
  /// so.
  void reopen();

  /// The daemon did something by itself, or its administrator: "started".
  void note_event(const std::string& event, const std::string& detail = "");

  /// A call changed something. `resource`: a job or sweep; empty: the daemon. `request_id`: the caller's, or empty.
  void note_change(const std::string& resource, const std::string& done, const std::string& caller,
                   const std::string& request_id);

  /// A call was refused. `caller`, `method`: empty if not known; `code`: of gRPC.
  void note_refusal(const std::string& method, const std::string& caller, const std::string& code,
                    const std::string& why);

  /// Number of lines of this process that could not be written.
  static std::int64_t lost_lines();

 private:
  using Clock = std::chrono::steady_clock;

  void write(const std::string& line);
  void write_refusals(const std::stop_token& stop);

  std::filesystem::path path_;
  Mutex mutex_;
  OpenFile file_ CELLCRUSH_GUARDED_BY(mutex_);
  bool failed_ CELLCRUSH_GUARDED_BY(mutex_) = false;  ///< the last line was not written
  Mutex refusals_mutex_;
  std::condition_variable_any refused_;
  std::vector<std::string> refusals_ CELLCRUSH_GUARDED_BY(refusals_mutex_);  ///< lines to be written
  Clock::time_point since_ CELLCRUSH_GUARDED_BY(refusals_mutex_);            ///< of `allowed_`
  double allowed_ CELLCRUSH_GUARDED_BY(refusals_mutex_) = kMostRefusals;     ///< lines
  int left_out_ CELLCRUSH_GUARDED_BY(refusals_mutex_) = 0;                   ///< since the last line of a refusal
  std::jthread thread_;
};

}  // namespace cellcrush
