#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "shortage.h"
#include "store/job_folder.h"
#include "store/report.pb.h"

namespace cellcrush::jobs {

/// How a worker's run ended, as the daemon sees it.
struct WorkerExit {
  enum class Kind {
    not_started,  ///< the worker could not be started; `code` is the errno
    exited,       ///< exited with `code`
    signalled,    ///< killed by the signal `code`
    gone,         ///< ended, but was not a child of this daemon, so its status is unknown
    broken,       ///< sent a malformed report and was killed
    stalled,      ///< used no processor time for long and was killed
    stopped,      ///< checkpointed the job because the daemon ends or the disk is nearly full
    suspended,    ///< checkpointed the job because it is suspended
    cancelled,    ///< the job was cancelled; the worker ended, or was killed after a timeout
    left,         ///< the daemon ends; the worker keeps running, and the next daemon adopts it
    displaced,    ///< the cluster ended the worker for a reason of its own: `detail`
    withdrawn,    ///< somebody cancelled the worker in the cluster: `detail`
  };
  Kind kind = Kind::exited;
  int code = 0;
  bool out_of_memory = false;            ///< the worker was killed while the kernel reported an OOM kill
  bool at_own_limit = false;             ///< of a control group of its own, not of the whole machine
  std::optional<worker::Final> final{};  ///< its last report, if any
  std::string detail{};                  ///< what happened, as a sentence, where the kind does not say it
  Trouble trouble{};                     ///< with not_started: what the executor lacks; `code` then does not count
};

/// Callbacks during a run, on the thread that called run.
struct WorkerEvents {
  std::function<void(int pid)> started;  ///< a worker runs, started by this daemon or an earlier one
  std::function<void(worker::Report&)>
      reported;  ///< every report except the final one and `stopping`, to be moved from; some repeat
  /// Where the executor has the job, as a short phrase (Job.place); empty: nowhere. Called on every change.
  std::function<void(const std::string& place)> placed;
  std::function<bool()> watched;  ///< whether somebody watches: reports are then delivered 20 times a second
};

/// Requests to a running worker. A worker that does not react in time is killed.
struct Interruptions {
  std::stop_token stop;     ///< the daemon ends, or the disk is nearly full: checkpoint the job and exit
  std::stop_token suspend;  ///< checkpoint the job and exit
  std::stop_token cancel;   ///< end the job and keep its results so far
};

/// Runs jobs in worker processes. Thread-safe: many runs at once.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Whether a worker runs in the folder.
  virtual bool has_worker(const store::JobFolder& folder) = 0;

  /// Delivers everything that workers have reported in the folder. Returns how the job ended, if the last worker ended
  /// it. REQUIRES: no worker runs in the folder.
  virtual std::optional<WorkerExit> read_final_report(const store::JobFolder& folder, const WorkerEvents& events) = 0;

  /// Whether workers go on while the daemon lacks a resource, to be adopted later.
  [[nodiscard]] virtual bool keeps_workers() const { return false; }

  /// Kills the worker that runs in the folder, if any.
  virtual void end_worker(const store::JobFolder& folder) = 0;

  /// Adopts the worker that runs in the folder, or starts one. Returns when it has ended or left the job, with all
  /// reports of the folder delivered. An exception from `events` kills the worker and propagates.
  virtual WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const WorkerEvents& events,
                         const Interruptions& interruptions) = 0;
};

/// What an executor may use of its daemon.
struct ExecutorSurroundings {
  std::filesystem::path data_folder;      ///< root of the data folder
  std::filesystem::path worker_program;   ///< started as `PROGRAM worker --folder DIR`
  std::chrono::milliseconds stall_limit;  ///< a worker that shows no sign of life for this long is replaced
  double step_cost = 0.0;                 ///< seconds of one core for an element-step of the reference crush
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
