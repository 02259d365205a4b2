#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "mutex.h"
#include "store/journal_reader.h"

namespace cellcrush::watch {

/// What was last read of the events of the jobs that are watched. Watchers that are up to date ask for the same: the
/// first of them reads it for all others. Memory is bounded: at most kMostJobs times kMostAnswers times kMostBytes.
/// Thread-safe.
class RecentEvents {
 public:
  using Event = std::shared_ptr<const v1::JobEvent>;

  static constexpr int kAtOnce = 256;  ///< events
  static constexpr std::size_t kMostJobs = 64;
  static constexpr std::size_t kMostAnswers = 4;         ///< of a job
  static constexpr std::size_t kMostBytes = 128 * 1024;  ///< of an answer that is kept, encoded

  /// Up to kAtOnce events after event `after`, in order; none only if there are none. `stamp`: Channel::stamp, from
  /// before the call: an answer holds as long as it is the same. Throws ServiceError: not_found if there is no such
  /// job, and the errors of JournalReader::events.
  std::vector<Event> after(store::JournalReader& journal, std::int64_t job, std::int64_t after, std::uint64_t stamp);

  /// How often the journal was read.
  [[nodiscard]] std::int64_t reads() const;

 private:
  struct Answers {
    std::uint64_t stamp = 0;
    std::map<std::int64_t, std::vector<Event>> events;  ///< by the number of the event before
    std::uint64_t turn = 0;                             ///< when they were last used
  };
  /// Of a job, without those of another stamp.
  Answers& answers_of(std::int64_t job, std::uint64_t stamp) CELLCRUSH_REQUIRES(mutex_);

  mutable Mutex mutex_;
  std::map<std::int64_t, Answers> answers_ CELLCRUSH_GUARDED_BY(mutex_);  ///< by job
  std::uint64_t turn_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::int64_t reads_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
};

}  // namespace cellcrush::watch
