#pragma once

#include <sys/types.h>

#include <csignal>
#include <filesystem>

#include "shortage.h"

namespace cellcrush::worker {

/// Exit codes of a worker process.
inline constexpr int kReported = 0;         ///< its final report states the outcome
inline constexpr int kNoReport = 3;         ///< it could not report the outcome
inline constexpr int kFolderIsClaimed = 4;  ///< another worker runs the job
/// It met a shortage and could not report it: this code plus the shortage's number.
inline constexpr int kShortage = 64;

/// The exit code of a worker that failed with this error before it could report.
int exit_code_of(const std::exception& error);

/// The shortage that an exit code means; none for other codes.
Shortage shortage_of_exit_code(int code);

/// Signals that request a stop; both are blocked at the start.
inline constexpr int kSuspendSignal = SIGTERM;
inline constexpr int kCancelSignal = SIGUSR1;

/// The main function of a worker process: claims the job's folder, reads its Order there, runs the job and reports.
/// It ends with the process `parent`, which started it; 0: it outlives that. Does not return.
[[noreturn]] void worker_main(const std::filesystem::path& folder, pid_t parent);

}  // namespace cellcrush::worker
