#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "mutex.h"
#include "store/journal_reader.h"

namespace cellcrush::watch {

/// The newest states and samples of the jobs that are watched. The first watcher that asks for events reads them from
/// the journal for all others. A watcher that lags behind reads the journal for itself, so that memory is bounded: at
/// most kMostJobs times kMostBytes. Thread-safe.
class RecentEvents {
 public:
  using Event = std::shared_ptr<const v1::JobEvent>;

  static constexpr int kAtOnce = 256;  ///< events
  static constexpr std::size_t kMostJobs = 64;
  static constexpr std::size_t kMostBytes = 512 * 1024;  ///< of the events of a job, encoded

  /// Up to kAtOnce events after event `after`, in order; none only if there are none. `stamp`: Channel::stamp, from
  /// before the call; the journal is read only if it has changed. Throws ServiceError: not_found if there is no such
  /// job, and the errors of JournalReader::events.
  std::vector<Event> after(store::JournalReader& journal, std::int64_t job, std::int64_t after, std::uint64_t stamp);

  /// How often the journal was read.
  [[nodiscard]] std::int64_t reads() const;

 private:
  /// All events of a job that are still valid, behind event `begin`.
  struct Tail {
    std::int64_t begin = 0;
    std::deque<Event> events;
    std::size_t bytes = 0;     ///< of the events, encoded
    std::uint64_t stamp = 0;   ///< of the last look into the journal
    bool is_complete = false;  ///< nothing followed then
    std::uint64_t turn = 0;    ///< when it was last used

    [[nodiscard]] std::int64_t end() const { return events.empty() ? begin : events.back()->sequence(); }
    void add(const Event& event);
    void drop_first();
  };

  /// Adds what the journal has behind the tail, and returns it. Throws as `after`.
  std::vector<Event> look_behind(store::JournalReader& journal, std::int64_t job, Tail& tail, std::uint64_t stamp)
      CELLCRUSH_REQUIRES(mutex_);
  Tail& tail_of(std::int64_t job, std::int64_t after) CELLCRUSH_REQUIRES(mutex_);

  mutable Mutex mutex_;
  std::map<std::int64_t, Tail> tails_ CELLCRUSH_GUARDED_BY(mutex_);  ///< by job
  std::uint64_t turn_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::int64_t reads_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
};

}  // namespace cellcrush::watch
