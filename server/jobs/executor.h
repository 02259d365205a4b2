#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "store/job_folder.h"
#include "worker/report.pb.h"

namespace cellcrush::jobs {

/// How a worker's run ended, seen from outside.
struct WorkerExit {
  enum class Kind {
    not_started,  ///< no worker could be started; `code` is the errno
    exited,       ///< ended by itself with `code`
    signalled,    ///< ended by the signal `code`
    gone,         ///< ended, and was no child of this daemon: how is not known
    broken,       ///< said something that is no report, and was ended
    stalled,      ///< used no processor time for long, and was ended
    stopped,      ///< left the job because the daemon ends or the disk is nearly full
    suspended,    ///< left the job because it is suspended
    cancelled,    ///< the job was cancelled, and it ended by itself or, when it did not in time, was ended
  };
  Kind kind = Kind::exited;
  int code = 0;
  bool out_of_memory = false;  ///< the kernel ended a process for want of memory while it ran, and it was killed
  std::optional<worker::Final> final;  ///< its last report, if it made one
};

/// What the executor tells while a worker runs, from the thread that called run.
struct WorkerEvents {
  std::function<void(int pid)> started;  ///< a worker runs, of this daemon or of one before it
  std::function<void(worker::Report&)>
      reported;                   ///< all reports but the final one and `stopping`, to be taken; some again
  std::function<bool()> watched;  ///< whether somebody waits for them: they are then told 20 times a second
};

/// Wishes of others while a worker runs. A worker that does not heed one in time is ended.
struct Interruptions {
  std::stop_token
      stop;  ///< the daemon ends, or the disk is nearly full: the worker is to leave the job at a checkpoint
  std::stop_token suspend;  ///< the worker is to leave the job at a checkpoint
  std::stop_token cancel;   ///< the worker ends the job and keeps the results so far
};

/// Runs jobs in worker processes. Thread-safe: many runs at once.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Whether a worker runs in the folder.
  virtual bool has_worker(const store::JobFolder& folder) = 0;

  /// Tells all that workers have reported in the folder. How the job ended, if the last of them has ended it. REQUIRES:
  /// none runs in it.
  virtual std::optional<WorkerExit> read_final_report(const store::JobFolder& folder, const WorkerEvents& events) = 0;

  /// Ends the worker that runs in the folder, if one does.
  virtual void end_worker(const store::JobFolder& folder) = 0;

  /// Goes along with the worker that runs in the folder, or starts one; waits until it has ended or left the job. All
  /// that the folder's workers have reported is told. An exception thrown by `events` ends the worker and is passed on.
  virtual WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const WorkerEvents& events,
                         const Interruptions& interruptions) = 0;
};

}  // namespace cellcrush::jobs
