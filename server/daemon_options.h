#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "access/gate.h"
#include "allotment.h"
#include "clocks.h"
#include "heartbeats.h"
#include "jobs/admission.h"
#include "jobs/deletion.h"
#include "jobs/executor.h"
#include "jobs/queue_hold.h"
#include "net/connection_limits.h"
#include "notices/notice.h"
#include "watch/watch_times.h"

namespace cellcrush {

struct DaemonOptions {
  /// Each "unix:PATH" or "HOST:PORT" (listen_address.h). Empty: a socket in the data folder and 127.0.0.1:50551.
  std::vector<std::string> listen;
  std::filesystem::path data_folder;
  /// Who may call over TCP, and how callers are identified.
  access::Options access;
  net::ConnectionLimits connections;
  /// Loopback address "HOST:PORT" that serves metrics over HTTP. Empty: nowhere.
  std::string metrics;
  /// File of who changed what and whom the daemon refused (audit_log.h). Empty: none.
  std::filesystem::path audit_log;
  /// Whom to tell of what happens.
  notices::Options notices;
  /// Address "HOST:PORT" that serves the API and the web page over HTTP, with TLS if `access` has it, or "none".
  /// Empty: 127.0.0.1:8080, or nowhere if that is in use or the other options forbid it.
  std::string http;
  /// Origins, such as "https://grafana.example.org", whose pages may show the web page in a frame.
  std::vector<std::string> framing_origins;
  /// Address of the page for users, where a proxy or tunnel stands before it. Empty: that of `http`.
  std::string public_url;
  /// Number of jobs that run at once on this machine. 0: the number of cores that the daemon may use (allotment.h).
  int workers = 0;
  /// Device that advances the runs that it can, on this machine: see open_device (worker/device_of_run.h). Empty: none.
  std::string device;
  /// Program started as `PROGRAM worker ...`.
  std::filesystem::path worker_program = "/proc/self/exe";
  /// Executor of jobs and sweeps whose request names none: "local" or one of `executors`.
  std::string default_executor = store::kLocalExecutor;
  /// Executors beside that of this machine.
  std::vector<jobs::ExecutorOptions> executors;
  /// Wall-clock time between two checkpoints of a running job.
  std::chrono::milliseconds checkpoint_interval{60'000};
  /// A worker that reports nothing and uses no processor time for this long is replaced.
  std::chrono::milliseconds stall_limit{20'000};
  /// Limits for new jobs.
  jobs::Admission::Limits limits;
  /// Which ended jobs and sweeps to keep. Default all, indefinitely.
  jobs::Retention::Limits keep;
  Clocks clocks;
  /// Interval between checks of the disk, the clocks and the ended jobs.
  std::chrono::milliseconds housekeeping_interval{5'000};
  /// Pauses before the daemon retries a shortage that holds the queue.
  jobs::HoldTimes hold_times;
  /// Called after a client has asked the daemon to drain. The callee then stops it.
  std::function<void()> on_drain;
  watch::WatchTimes watch_times;
  /// How often the loops of the daemon beat.
  Heartbeats::Times heartbeats;
  /// Called at each beat while all loops make progress.
  std::function<void()> on_progress;

  /// `workers`, or the number of usable cores if that is 0.
  [[nodiscard]] int worker_count() const { return workers > 0 ? workers : usable_cores().count; }
};

}  // namespace cellcrush
