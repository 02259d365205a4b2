#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "mutex.h"
#include "store/contents.h"
#include "store/job_filter.h"
#include "store/journal_schema.h"
#include "store/page_room.h"
#include "store/queued_job.h"
#include "store/sample_reader.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A job as stored, with name and case but without progress.
struct StoredJob {
  std::int64_t number = 0;
  v1::Job job;
  std::int64_t last_sequence = 0;
  std::int64_t samples = 0;  ///< since it last began
  bool has_case = true;      ///< whether its case could be read; an empty one stands for it otherwise
  bool is_damaged = false;   ///< `job` is then FAILED with STORE_CORRUPT, whatever it was
};

/// Consecutive samples of a job.
struct StoredSamples {
  std::vector<v1::Sample> samples;
  std::int64_t last_sequence = 0;  ///< of the last sample; 0 if there is none
  bool has_more = false;           ///< whether more follow
};

/// Reads the journal beside its writer, and the samples that it counts in the jobs' folders; sees committed data.
/// Thread-safe. Failures throw ServiceError: data_loss for an unreadable event.
class JournalReader {
 public:
  /// REQUIRES: a Journal was opened on the same path.
  explicit JournalReader(const std::filesystem::path& path);

  [[nodiscard]] const Epoch& epoch() const { return epoch_; }

  std::optional<StoredJob> find_job(std::int64_t job);

  /// The same with an empty case, however large that is.
  std::optional<StoredJob> find_without_case(std::int64_t job);

  /// The job at each change of its state, in order, without its case. Leaves out those that cannot be read.
  std::vector<v1::Job> states(std::int64_t job);

  /// Journal rows, and results of ended jobs, by owner.
  std::map<std::string, std::int64_t> bytes_by_owner();

  /// Whether the job exists.
  bool has_job(std::int64_t job);

  /// Up to `limit` of the selected jobs after number `after` (0: from the start), in ascending order of their numbers,
  /// or descending with `newest_first`. Ends with the job that makes the total exceed `most_bytes`. Throws ServiceError
  /// (cancelled) once `given_up` returns true.
  std::vector<StoredJob> list_jobs(
      const JobFilter& wanted, bool newest_first, std::int64_t after, int limit,
      std::size_t most_bytes = std::numeric_limits<std::size_t>::max(),
      const std::function<bool()>& given_up = [] { return false; });

  /// Totals of the ended jobs.
  EndedTotals ended_totals();

  /// Up to `limit` undamaged jobs that ended after `after`, ordered by ended_at and job.
  std::vector<EndedJob> ended_jobs(const EndedJob& after, int limit);

  /// Up to `limit` ended jobs whose size is not recorded yet (Journal::set_measured).
  std::vector<std::int64_t> jobs_to_measure(int limit);

  /// Size of the owner's jobs: journal rows, and the results of those that have ended.
  std::int64_t bytes_of_owner(const std::string& owner);

  /// Numbers of the jobs whose folders still have to be deleted; never of a job that exists.
  std::vector<std::int64_t> deleted_jobs();

  /// The jobs in a state, oldest first, with what the scheduler needs; those of one executor, or of all.
  std::vector<QueuedJob> queued_jobs(v1::Job::State state, const std::optional<std::string>& executor = {});

  /// The same for one job; nothing unless it is in that state.
  std::optional<QueuedJob> queued_job(std::int64_t job, v1::Job::State state);

  /// Executor of the job; nothing if there is no such job.
  std::optional<std::string> executor_of(std::int64_t job);

  /// Executors that have jobs which have not ended.
  std::vector<std::string> executors_in_use();

  /// States (without their cases) and samples after `after`, in order. Ends before an unreadable one; throws data_loss
  /// if that is the first.
  std::vector<v1::JobEvent> events(std::int64_t job, std::int64_t after, int limit);

  /// The samples after event `after`, in order. Ends before an unreadable one; throws data_loss if that is the first.
  StoredSamples samples(std::int64_t job, std::int64_t after = 0, PageRoom room = {});

  /// Nothing until a worker has sent it, or if it cannot be read.
  std::optional<v1::Mesh> mesh(std::int64_t job);

 private:
  /// The columns of `jobs` that read_job takes.
  static constexpr const char* kJobColumns =
      "number, job, submitted_case, last_sequence, state, samples, checksum = expected_checksum, "
      "case_checksum = row_checksum(submitted_case)";
  /// A row damaged since the journal was opened is presented as such.
  StoredJob read_job(const Statement& row) CELLCRUSH_REQUIRES(mutex_);

  /// Numbers between these two, exclusive.
  struct Range {
    std::int64_t low = 0;
    std::int64_t high = 0;
  };
  std::vector<StoredJob> read_batch(const JobFilter& wanted, bool newest_first, const Range& range, int limit);
  std::int64_t newest_number();

  struct Numbers;
  Numbers numbers_of(std::int64_t job);
  /// Logs it once in each run of a job.
  void say_missing(std::int64_t job, const Numbers& numbers);
  /// Calls use(numbers) until the samples that it has read are those of the numbers.
  template <typename Use>
  void with_numbers(std::int64_t job, const Use& use);
  /// Throws ServiceError (data_loss) if the first sample of a job that has ended cannot be read.
  SampleReader::Found find_samples(const Numbers& numbers, const SampleRange& range, PageRoom room);
  std::vector<v1::JobEvent> read_events(std::int64_t job, const Numbers& numbers, std::int64_t after, int limit);

  Mutex mutex_;
  Database database_ CELLCRUSH_GUARDED_BY(mutex_);
  ContentReader contents_ CELLCRUSH_GUARDED_BY(mutex_);
  std::set<std::pair<std::int64_t, std::int64_t>> said_ CELLCRUSH_GUARDED_BY(mutex_);  ///< jobs and runs, once each
  Epoch epoch_;
  SampleReader samples_;
};

}  // namespace cellcrush::store
