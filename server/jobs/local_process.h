#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "jobs/executor.h"

namespace cellcrush::jobs {

/// Number of processes that the kernel has killed for lack of memory.
using OomKills = std::function<std::uint64_t()>;

/// Counts OOM kills in this process's control group, which its workers share (memory.events). Without one it counts
/// those of the machine (/proc/vmstat). 0 if neither can be read. Thread-safe.
std::uint64_t count_oom_kills();

/// Workers as processes on this machine: `program worker --folder DIR`.
class LocalProcess final : public Executor {
 public:
  /// Whether a worker outlives the process that started it.
  enum class Life { outlives_parent, ends_with_parent };

  /// A worker that reports nothing and uses no processor time for `stall_limit` has stalled. `oom_kills` defaults to
  /// count_oom_kills; tests replace it.
  LocalProcess(std::filesystem::path program, std::chrono::milliseconds stall_limit,
               OomKills oom_kills = count_oom_kills, Life life = Life::outlives_parent)
      : program_(std::move(program)), stall_limit_(stall_limit), oom_kills_(std::move(oom_kills)), life_(life) {}

  /// Has a device advance the runs that it can (cellcrush/device.h).
  void use_device(std::string device) { device_ = std::move(device); }

  bool has_worker(const store::JobFolder& folder) override;
  std::optional<WorkerExit> read_final_report(const store::JobFolder& folder, const WorkerEvents& events) override;
  void end_worker(const store::JobFolder& folder) override;
  WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const WorkerEvents& events,
                 const Interruptions& interruptions) override;

 private:
  std::filesystem::path program_;
  std::chrono::milliseconds stall_limit_;
  OomKills oom_kills_;
  Life life_;
  std::string device_;  ///< empty: none
};

}  // namespace cellcrush::jobs
