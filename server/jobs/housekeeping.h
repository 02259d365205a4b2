#pragma once

#include <chrono>
#include <stop_token>
#include <thread>

#include "jobs/admission.h"
#include "jobs/scheduler.h"

namespace cellcrush::jobs {

/// What the daemon does by itself: while the disk has too little room, no job runs; jobs that ended long ago are deleted.
class Housekeeping {
 public:
  /// What it works with; all of it outlives it.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    const Admission& admission;
    Scheduler& scheduler;
    std::chrono::milliseconds interval;    ///< between two looks at the disk
    std::chrono::seconds keep_ended_jobs;  ///< 0: for good
  };

  explicit Housekeeping(const Parts& parts) : parts_(parts) {}

  /// Holds the queue where the disk has too little room, before a job starts. Throws ServiceError.
  void look_at_disk();

  /// Does all of it from now on, in a thread of its own.
  void start() {
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }

 private:
  void work(const std::stop_token& stop);
  void delete_old_jobs();

  Parts parts_;
  std::jthread thread_;
};

}  // namespace cellcrush::jobs
