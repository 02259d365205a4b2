#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "jobs/queue_hold.h"
#include "metrics/metrics.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

/// Writes what became of a job into the journal, however long the disk is short of room. Thread-safe.
class StateWriter {
 public:
  static constexpr std::chrono::seconds kBetweenTries{1};

  /// Dependencies; all outlive the writer.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    metrics::Metrics& metrics;
    QueueHold& hold;
    /// Called with the waiting jobs that were CANCELLED because a job of their sweep failed.
    std::function<void(const std::vector<std::int64_t>&)> stopped;
    /// Called with every job that has ended.
    std::function<void(std::int64_t)> ended;
  };

  explicit StateWriter(Parts parts) : parts_(std::move(parts)) {}

  /// Retries until the write succeeds or the daemon ends. Returns the state written, if any; CANCELLING if the job is
  /// in that state and the transition is not allowed. Does not throw.
  v1::Job::State write(std::int64_t job, const store::StateChange& change, const std::stop_token& daemons_end);

  /// Nothing if it cannot be written now. `logged`: the last reason, so that each is logged once. Does not throw.
  std::optional<v1::Job::State> try_write(std::int64_t job, const store::StateChange& change, std::string& logged);

  /// Returns a job that met a shortage to the queue. Returns its state then: CANCELLING if it was cancelled. Does not
  /// throw.
  v1::Job::State put_back(std::int64_t job, const Trouble& shortage, const std::stop_token& daemons_end);

 private:
  /// As put_back; throws what the journal throws.
  v1::Job::State try_put_back(std::int64_t job, const Trouble& shortage, const std::stop_token& daemons_end);
  void tidy_up(std::int64_t job, const store::StateChange& change);

  Parts parts_;
};

}  // namespace cellcrush::jobs
