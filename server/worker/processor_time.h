#pragma once

#include <ctime>

namespace cellcrush::worker {

/// Processor time, s: CLOCK_THREAD_CPUTIME_ID for this thread, CLOCK_PROCESS_CPUTIME_ID for the process. Other load on
/// the machine is not included.
inline double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace cellcrush::worker
