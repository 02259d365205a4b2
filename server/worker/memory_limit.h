#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "store/report.pb.h"

namespace cellcrush::worker {

/// Limits the memory that this process may write (RLIMIT_DATA) while it exists. When an allocation of C++ then fails,
/// in whichever thread, it lifts the limit and calls `ran_out` once, which ends the process. At most one at a time.
class MemoryLimit {
 public:
  /// `bytes`: 0 for no limit. A lower hard limit of the process stays.
  MemoryLimit(std::int64_t bytes, std::function<void()> ran_out);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  friend void end_for_memory();
  std::function<void()> ran_out_;
};

/// The report of a run that needs more memory than it is allowed: used, allowed and remedy. Without a summary, so that
/// the daemon lets another attempt, which is allowed more, continue it. Lifts the limit.
Final out_of_memory();

}  // namespace cellcrush::worker
