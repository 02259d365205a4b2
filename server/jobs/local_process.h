#pragma once

#include <filesystem>
#include <utility>

#include "jobs/executor.h"

namespace cellcrush::jobs {

/// Workers as child processes on this machine: `program worker --daemon PID`, with a socket at descriptor 3. The kernel
/// ends a worker together with the thread that started it.
class LocalProcess final : public Executor {
 public:
  explicit LocalProcess(std::filesystem::path program) : program_(std::move(program)) {}

  WorkerExit run(const worker::Order& order, const WorkerEvents& events, const Interruptions& interruptions) override;

 private:
  std::filesystem::path program_;
};

}  // namespace cellcrush::jobs
