#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "access/gate.h"
#include "clocks.h"
#include "jobs/admission.h"
#include "jobs/queue_hold.h"
#include "jobs/retention.h"
#include "net/connection_limits.h"
#include "watch/watch_times.h"

namespace cellcrush {

struct DaemonOptions {
  /// Each "unix:PATH" or "HOST:PORT" (listen_address.h). Empty: a socket in the data folder and 127.0.0.1:50551.
  std::vector<std::string> listen;
  std::filesystem::path data_folder;
  /// Who may call on TCP, and by what he is known.
  access::Options access;
  net::ConnectionLimits connections;
  /// "HOST:PORT" of loopback at which metrics are served over HTTP. Empty: nowhere.
  std::string metrics;
  /// Jobs that run at once. 0: as many as this machine has cores.
  int workers = 0;
  /// Program that is started as `PROGRAM worker ...`.
  std::filesystem::path worker_program = "/proc/self/exe";
  /// Clock time between two checkpoints of a running job.
  std::chrono::milliseconds checkpoint_interval{60'000};
  /// A worker that says nothing and uses no processor time for so long is replaced.
  std::chrono::milliseconds stall_limit{20'000};
  /// What new jobs are held to.
  jobs::Admission::Limits limits;
  /// What of jobs and sweeps that have ended is kept; by default all, for good.
  jobs::Retention::Limits keep;
  Clocks clocks;
  /// Between two looks at the disk, the clocks and what has ended.
  std::chrono::milliseconds housekeeping_interval{5'000};
  /// Pauses before a shortage that holds the queue is tried again.
  jobs::HoldTimes hold_times;
  /// Called when a client has asked the daemon to end, which is then to be stopped.
  std::function<void()> on_drain;
  watch::WatchTimes watch_times;

  /// `workers`, or the number of cores where that is 0.
  [[nodiscard]] int worker_count() const {
    return workers > 0 ? workers : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
};

}  // namespace cellcrush
