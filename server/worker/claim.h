#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

#include "store/job_folder.h"

namespace cellcrush::worker {

/// Takes the job's folder for this process, until it ends: a lock on the file `worker`, which then holds the process's
/// number and start time. False when another worker has it. Throws ServiceError where the file cannot be written.
bool claim(const store::JobFolder& folder);

/// Which process runs a job; its start time, in the kernel's ticks since boot, tells it from a later one with the same
/// number.
struct Claim {
  pid_t process = 0;
  std::uint64_t start_time = 0;
};

/// The process that has claimed the folder and lives; nothing when none has. Throws ServiceError when that cannot be
/// read.
std::optional<Claim> find_claim(const store::JobFolder& folder);

/// Start time and processor time of a process, in the kernel's ticks; nothing when there is none of that number.
/// `times_of` throws ServiceError when that cannot be read.
struct ProcessTimes {
  std::uint64_t start = 0;
  std::uint64_t used = 0;
};
std::optional<ProcessTimes> times_of(pid_t process);

}  // namespace cellcrush::worker
