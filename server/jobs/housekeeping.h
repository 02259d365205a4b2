#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <thread>

#include "clocks.h"
#include "jobs/admission.h"
#include "jobs/clock_watch.h"
#include "jobs/retention.h"
#include "jobs/scheduler.h"

namespace cellcrush::jobs {

/// What the daemon does by itself: while the disk has too little room, no job runs; what ended too long ago is deleted;
/// a wall clock that was set is named in the log.
class Housekeeping {
 public:
  /// What it works with; all of it outlives it.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    store::SweepReader& sweeps;
    const Deletion& deletion;
    const Admission& admission;
    Scheduler& scheduler;
    QueueHold& hold;
    std::chrono::milliseconds interval;  ///< between two rounds
    Retention::Limits keep;
    Clocks clocks;
  };

  explicit Housekeeping(const Parts& parts)
      : parts_(parts),
        retention_({parts.folder, parts.journal, parts.reader, parts.sweeps}, parts.deletion, parts.keep),
        clock_watch_(parts.clocks),
        noted_(parts.journal.service_seconds()) {}

  /// Holds the queue where the disk has too little room, before a job starts. Throws ServiceError.
  void look_at_disk();

  /// Does all of it from now on, in a thread of its own.
  void start() {
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }

 private:
  void work(const std::stop_token& stop);
  void look_at_clocks();
  void delete_ended(const std::stop_token& stop);

  Parts parts_;
  Retention retention_;
  ClockWatch clock_watch_;
  std::int64_t noted_;  ///< second of the service clock that was made durable last
  std::jthread thread_;
};

}  // namespace cellcrush::jobs
