#pragma once

#include <ctime>

namespace cellcrush::worker {

/// Processor time of a clock, s: CLOCK_THREAD_CPUTIME_ID of this thread, CLOCK_PROCESS_CPUTIME_ID of the process. What
/// else the machine does at the moment is no part of it.
inline double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace cellcrush::worker
