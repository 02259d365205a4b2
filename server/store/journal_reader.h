#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "mutex.h"
#include "store/ended_job.h"
#include "store/epoch.h"
#include "store/job_filter.h"
#include "store/page_room.h"
#include "store/queued_job.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A job as the journal has it: name and case filled in, progress not.
struct StoredJob {
  std::int64_t number = 0;
  v1::Job job;
  std::int64_t last_sequence = 0;
};

/// Samples of a job that follow each other.
struct StoredSamples {
  std::vector<v1::Sample> samples;
  std::int64_t last_sequence = 0;  ///< of the last of them; 0 without any
  bool has_more = false;           ///< whether others come behind them
};

/// Reads the journal beside its writer; sees what is committed. Thread-safe. Failures throw ServiceError: data_loss for
/// an event that cannot be read.
class JournalReader {
 public:
  /// REQUIRES: a Journal has been opened on the same path.
  explicit JournalReader(const std::filesystem::path& path);

  [[nodiscard]] const Epoch& epoch() const { return epoch_; }

  std::optional<StoredJob> find_job(std::int64_t job);

  /// Whether there is such a job.
  bool has_job(std::int64_t job);

  /// Up to `limit` of the wanted jobs behind the one with the number `after` (0: from the beginning), in the order of
  /// their numbers or, with `newest_first`, against it. Ends behind the one with which they have more than
  /// `most_bytes`. Throws ServiceError (cancelled) once `given_up` says that nobody waits any more.
  std::vector<StoredJob> list_jobs(
      const JobFilter& wanted, bool newest_first, std::int64_t after, int limit,
      std::size_t most_bytes = std::numeric_limits<std::size_t>::max(),
      const std::function<bool()>& given_up = [] { return false; });

  /// Jobs that have ended, and what they take.
  EndedTotals ended_totals();

  /// Up to `limit` jobs that ended behind `after`, of which ended_at and job count, in that order.
  std::vector<EndedJob> ended_jobs(const EndedJob& after, int limit);

  /// Up to `limit` jobs that have ended and of which Journal::set_measured is to be told.
  std::vector<std::int64_t> jobs_to_measure(int limit);

  /// What the owner's jobs take: rows in the journal, and of those that have ended the results.
  std::int64_t bytes_of_owner(const std::string& owner);

  /// Numbers of the jobs whose folders are still to be removed.
  std::vector<std::int64_t> deleted_jobs();

  /// The jobs in a state, oldest first, with what the scheduler asks of them.
  std::vector<QueuedJob> queued_jobs(v1::JobState state);

  /// The same of one job; nothing unless it is in that state.
  std::optional<QueuedJob> queued_job(std::int64_t job, v1::JobState state);

  /// States (without their cases) and samples behind `after`, in order. Ends before one that cannot be read; throws
  /// data_loss when that is the first.
  std::vector<v1::JobEvent> events(std::int64_t job, std::int64_t after, int limit);

  /// The samples behind the event `after`, in order. Ends before one that cannot be read; throws data_loss when that is
  /// the first.
  StoredSamples samples(std::int64_t job, std::int64_t after = 0, PageRoom room = {});

  /// Step of the newest sample; -1 before the first.
  std::int64_t last_sampled_step(std::int64_t job);

  /// Nothing while no worker has sent it, or when it cannot be read.
  std::optional<v1::Mesh> mesh(std::int64_t job);

 private:
  /// Of a row with number, job, submitted_case, last_sequence, state. What was damaged since the journal was opened is
  /// shown as such.
  static StoredJob read_job(const Statement& row);

  /// Numbers between these two, both excluded.
  struct Range {
    std::int64_t low = 0;
    std::int64_t high = 0;
  };
  std::vector<StoredJob> read_batch(const JobFilter& wanted, bool newest_first, const Range& range, int limit);
  std::int64_t newest_number();

  Mutex mutex_;
  Database database_ CELLCRUSH_GUARDED_BY(mutex_);
  Epoch epoch_;
};

}  // namespace cellcrush::store
