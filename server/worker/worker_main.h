#pragma once

#include <csignal>
#include <filesystem>

#include "shortage.h"

namespace cellcrush::worker {

/// How a worker process ends.
inline constexpr int kReported = 0;         ///< its last report says how the run ended
inline constexpr int kNoReport = 3;         ///< it could not say how
inline constexpr int kFolderIsClaimed = 4;  ///< another worker runs the job
/// It met a shortage and could not report it: this code and the shortage's number.
inline constexpr int kShortage = 64;

/// The exit code of a worker that failed with this error before it could report.
int exit_code_of(const std::exception& error);

/// The shortage that an exit code stands for; none for others.
Shortage shortage_of_exit_code(int code);

/// What a worker is told by; both are blocked when it starts.
inline constexpr int kSuspendSignal = SIGTERM;
inline constexpr int kCancelSignal = SIGUSR1;

/// The whole of a worker process: claims the job's folder, reads its Order there, runs the job and reports. It outlives
/// the daemon that started it. Does not return.
[[noreturn]] void worker_main(const std::filesystem::path& folder);

}  // namespace cellcrush::worker
