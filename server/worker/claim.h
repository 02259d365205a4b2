#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

#include "store/job_folder.h"

namespace cellcrush::worker {

/// Claims the job's folder for this process until it ends: locks the file `worker` and writes the process's id and
/// start time. False if another worker holds it. Throws ServiceError if the file cannot be written.
bool claim(const store::JobFolder& folder);

/// The process that runs a job. The start time, in kernel ticks since boot, distinguishes it from a later process with
/// the same id.
struct Claim {
  pid_t process = 0;
  std::uint64_t start_time = 0;
};

/// The live process that has claimed the folder; nothing if there is none. Throws ServiceError if that cannot be read.
std::optional<Claim> find_claim(const store::JobFolder& folder);

/// Start time and processor time of a process, in kernel ticks; nothing if there is no such process. Throws
/// ServiceError if they cannot be read.
struct ProcessTimes {
  std::uint64_t start = 0;
  std::uint64_t used = 0;
};
std::optional<ProcessTimes> times_of(pid_t process);

/// The most resident memory that a process has had, bytes; 0 if there is no such process.
std::int64_t peak_memory_of(pid_t process);

}  // namespace cellcrush::worker
