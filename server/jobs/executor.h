#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "worker/report.pb.h"

namespace cellcrush::jobs {

/// How a worker's run ended, seen from outside.
struct WorkerExit {
  enum class Kind {
    not_started,  ///< no worker could be started; `reason` says why
    exited,       ///< ended by itself with `code`
    signalled,    ///< ended by the signal `code`
    broken,       ///< said something that is no report, and was ended
    stopped,      ///< ended because the daemon ends
    cancelled,    ///< the job was cancelled, and it ended by itself or, when it did not in time, was ended
  };
  Kind kind = Kind::exited;
  int code = 0;
  std::string reason;
  std::optional<worker::Final> final;  ///< its last report, if it made one
};

/// What the executor tells while a worker runs, from the thread that called run.
struct WorkerEvents {
  std::function<void(int pid)> started;                 ///< before the worker is told what to do
  std::function<void(const worker::Report&)> reported;  ///< all reports but the final one and `stopping`
};

/// Wishes of others while a worker runs.
struct Interruptions {
  std::stop_token stop;    ///< the daemon ends: the worker is ended at once
  std::stop_token cancel;  ///< the job is cancelled: the worker is told, and ended if it does not react within 2 s
};

/// Runs jobs in worker processes. Thread-safe: many runs at once.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Runs one job to its end; waits for it. The worker is gone when this returns. An exception thrown by `events` ends
  /// the worker and is passed on.
  /// REQUIRES: the calling thread lives as long as the worker.
  virtual WorkerExit run(const worker::Order& order, const WorkerEvents& events,
                         const Interruptions& interruptions) = 0;
};

}  // namespace cellcrush::jobs
