#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <thread>

#include "clocks.h"
#include "jobs/admission.h"
#include "jobs/deletion.h"
#include "jobs/queues.h"
#include "mutex.h"

namespace cellcrush::jobs {

/// Periodic work of the daemon: holds the queues while the disk is nearly full, deletes expired jobs, and logs a change
/// of the wall clock.
class Housekeeping {
 public:
  /// Dependencies; all outlive this object.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    store::SweepReader& sweeps;
    const Deletion& deletion;
    const Admission& admission;
    Queues& queues;
    std::chrono::milliseconds interval;  ///< between two rounds
    Retention::Limits keep;
    Clocks clocks;
    std::function<void(bool)> journal_is_whole;  ///< called in every round
  };

  explicit Housekeeping(const Parts& parts)
      : parts_(parts),
        retention_({parts.folder, parts.journal, parts.reader, parts.sweeps}, parts.deletion, parts.keep),
        clock_offset_(parts.clocks.wall() - parts.clocks.uptime()),
        noted_(parts.journal.service_seconds()) {}

  /// Holds the queues if the disk is nearly full, before a job starts. Throws ServiceError.
  void check_disk();

  /// Repeats all checks from now on, in its own thread.
  void start() {
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }

  /// Waits for the check that runs. Safe to repeat.
  void stop() { thread_ = {}; }

  /// Has its thread run the work soon, between two checks or batches of deletions.
  void post(std::function<void()> work);

 private:
  void work(const std::stop_token& stop);
  void run_posted();
  /// False if a stop is requested.
  bool wait_for_next_round(const std::stop_token& stop);
  void check_clocks();
  /// Whether there may be more to delete at once.
  bool delete_ended(const std::stop_token& stop);

  Parts parts_;
  Retention retention_;
  std::chrono::nanoseconds clock_offset_;  ///< of the wall clock to the uptime, at the last check
  std::int64_t noted_;                     ///< service clock, s, when last made durable
  Mutex mutex_;
  std::condition_variable_any posted_;
  std::function<void()> work_ CELLCRUSH_GUARDED_BY(mutex_);  ///< posted; null: none
  std::jthread thread_;
};

}  // namespace cellcrush::jobs
