#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "jobs/executor.h"

namespace cellcrush::jobs {

/// What an executor may use of its daemon.
struct ExecutorSurroundings {
  std::filesystem::path data_folder;      ///< root of the data folder
  std::filesystem::path worker_program;   ///< started as `PROGRAM worker --folder DIR`
  std::chrono::milliseconds stall_limit;  ///< a worker that shows no sign of life for this long is replaced
  double step_cost = 0.0;                 ///< seconds of one core per element and step
};

/// An executor beside that of the daemon's machine.
struct ExecutorOptions {
  /// Name for requests and results, "slurm/NAME"; differs from those of all other executors.
  std::string name;
  /// Jobs that it has at once; at least 1.
  int slots = 1;
  /// Makes it, once, at the start of the daemon. Throws ServiceError if it cannot be used.
  std::function<std::unique_ptr<Executor>(const ExecutorSurroundings&)> make;
};

}  // namespace cellcrush::jobs
