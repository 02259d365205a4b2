#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jobs/queues.h"
#include "metrics/metrics.h"
#include "mutex.h"
#include "notices/courier.h"
#include "notices/notice.h"
#include "store/journal.h"

namespace cellcrush::notices {

/// Tells receivers outside the daemon what happens: webhooks, a command, a collector of traces. Ends of jobs and sweeps
/// come from the journal, so that none is missed while a receiver or the daemon is down; a queue that is held is told
/// if the receiver answers soon. Nothing waits for a receiver. Thread-safe.
class Notices {
 public:
  /// Dependencies; all outlive it.
  struct Parts {
    store::Journal& journal;
    store::ChangeReader& changes;
    store::JournalReader& reader;
    store::SweepReader& sweeps;
    metrics::Metrics& metrics;
    std::string epoch;  ///< of callers
  };

  /// Throws what check(options) throws.
  Notices(const Parts& parts, const Options& options);

  /// Begins to tell: a receiver that is new hears of what happens from now on, another one of what it has missed too.
  void start();

  /// Returns soon. What was not sent is told by the next daemon.
  void stop();

  /// What holds the queues now.
  void set_standings(const std::vector<jobs::Queues::Standing>& standings);

  /// Changes that a receiver has not seen, by its name.
  [[nodiscard]] std::map<std::string, std::int64_t> behind();

 private:
  Parts parts_;
  Mutex mutex_;
  std::map<std::string, Shortage> held_ CELLCRUSH_GUARDED_BY(mutex_);  ///< by executor: the first cause that holds it
  std::vector<std::unique_ptr<Courier>> couriers_;                     ///< constant from construction on
};

}  // namespace cellcrush::notices
