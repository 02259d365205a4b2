#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "mutex.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// What a row of the table `changes` says (journal_format.md). The numbers are stored.
enum class ChangeKind { job_state = 1, job_deleted = 2, sweep_changed = 3, sweep_deleted = 4 };

/// A change of a job or sweep. Changes of all of them are numbered in the order of their commits.
struct Change {
  std::int64_t number = 0;
  ChangeKind kind = ChangeKind::job_state;
  std::int64_t resource = 0;  ///< number of the job or sweep
  std::int64_t sequence = 0;  ///< of the state event; 0: another note in that of an ended job
};

/// Reads the changes of all jobs and sweeps beside the journal's writer; sees committed data. Thread-safe. Failures
/// throw ServiceError.
class ChangeReader {
 public:
  /// Count of the announcements of changes, and the time, s: not every change of a sweep is announced.
  using Stamp = std::pair<std::uint64_t, std::int64_t>;

  /// REQUIRES: a Journal was opened on the same path.
  explicit ChangeReader(const std::filesystem::path& path);

  /// Number of the last change; 0 before the first.
  std::int64_t last();

  /// Whether all changes after this one are still there.
  bool has_all_after(std::int64_t change);

  /// Whether there are changes after this one. The journal is read only if `stamp` is another one than in the last
  /// call, and so once for all callers that have seen the same announcements.
  bool has_after(std::int64_t change, const Stamp& stamp);

  /// Value of a fact about a receiver of changes (Journal::set_fact); empty: none.
  std::string fact(const std::string& name);

  /// Some changes in order, without damaged ones.
  struct Readable {
    std::vector<Change> changes;
    std::int64_t first = 0;  ///< number of the first change there was; 0: none
    std::int64_t last = 0;   ///< of the last one that was looked at
  };
  /// Looks at up to `limit` changes after this one. The log names damaged ones.
  Readable readable_after(std::int64_t change, int limit);

  /// Up to `limit` changes after this one, in order. Ends before a damaged one; throws data_loss if that is the first.
  std::vector<Change> after(std::int64_t change, int limit);

 private:
  std::int64_t read_last() CELLCRUSH_REQUIRES(mutex_);

  Mutex mutex_;
  Database database_ CELLCRUSH_GUARDED_BY(mutex_);
  std::optional<Stamp> stamp_ CELLCRUSH_GUARDED_BY(mutex_);  ///< of the last look
  std::int64_t last_ CELLCRUSH_GUARDED_BY(mutex_) = 0;       ///< change then
};

}  // namespace cellcrush::store
