#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cellcrush/v1/sweeps_service.pb.h"
#include "mutex.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"
#include "watch/hub.h"
#include "watch/watch_cursor.h"

namespace cellcrush::watch {

/// A watcher's position in the events of one job of a sweep.
struct JobPlace {
  std::int64_t job = 0;
  std::int64_t sequence = 0;  ///< of the last event sent; 0: none
  bool ended = false;         ///< its last event was sent
};

/// A watcher's positions in all jobs of a sweep, and their token. A run is a range of jobs with consecutive numbers and
/// equal positions. Most jobs of a sweep are in few runs, so that the token is short. A change takes as long in a large
/// sweep as in a small one. Not thread-safe.
class JobPlaces {
 public:
  JobPlaces() = default;
  /// REQUIRES: the jobs are in ascending order.
  explicit JobPlaces(std::vector<JobPlace> places);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  const JobPlace& operator[](std::size_t index) const { return places_[index]; }

  void set_sequence(std::size_t index, std::int64_t sequence);
  void set_ended(std::size_t index);

  [[nodiscard]] std::size_t run_count() const { return runs_.size(); }
  /// Takes time and bytes in proportion to the runs.
  [[nodiscard]] std::string token(std::int64_t sweep) const;

 private:
  void update_runs(std::size_t index);

  std::vector<JobPlace> places_;
  std::set<std::size_t> runs_;  ///< index of the first job of each run
};

/// The positions in a token, by job. Throws ServiceError (invalid) if it is not a token of this sweep.
std::map<std::int64_t, JobPlace> parse_resume_token(std::int64_t sweep, const std::string& token);

/// Source of a WatchSweep: a snapshot of the sweep, then the messages of each job's WatchCursor without mesh and
/// frames. Jobs with new events take turns, and only they are read. A cursor is released after its job's last event, so
/// that watching a large sweep costs little. Not thread-safe, except for `wake`.
class SweepSource {
 public:
  using Message = v1::WatchSweepResponse;
  static constexpr bool kIsWatch = true;

  /// An empty token starts with all events. Throws ServiceError: not_found, invalid for another sweep's token, or
  /// failed_precondition for one of another epoch.
  SweepSource(store::JournalReader& journal, store::SweepReader& sweeps, Hub& hub, std::int64_t sweep,
              const std::string& resume_token);

  /// Calls `wake` from now on whenever there may be another message, on other threads and under locks: it must be
  /// quick.
  void open(const std::function<void()>& wake);
  /// Once this returns, `wake` is not called again.
  void close();

  /// Throws ServiceError if the journal cannot be read, or out_of_range if the token named an event that does not
  /// exist.
  std::optional<SentMessage> next();
  /// Whether next has a message without reading the journal: the job whose turn it is holds one.
  [[nodiscard]] bool has_more() const { return has_more_; }
  [[nodiscard]] bool ended() const { return snapshot_sent_ && left_ == 0; }
  [[nodiscard]] SentMessage bookmark() const;
  [[nodiscard]] static std::string resume_advice() { return "with the most recent resume_token"; }

 private:
  struct Member {
    std::shared_ptr<Channel> channel;
    std::uint64_t subscription = 0;
    std::optional<WatchCursor> cursor;
  };

  // Positions of the jobs with new events, each at most once; shared with the wakes.
  class News {
   public:
    explicit News(std::size_t jobs) : is_queued_(jobs, false) {}
    void add(std::size_t position);
    /// False if it was already queued, at its place behind others.
    bool add_first(std::size_t position);
    std::optional<std::size_t> take();

   private:
    Mutex mutex_;
    std::deque<std::size_t> queue_ CELLCRUSH_GUARDED_BY(mutex_);
    std::vector<bool> is_queued_ CELLCRUSH_GUARDED_BY(mutex_);
  };

  [[nodiscard]] std::string resume_token() const;
  /// Whether an event of this many bytes is to carry a token: a long one only after as many bytes of events.
  bool is_token_due(std::size_t event_bytes);
  [[nodiscard]] std::map<std::int64_t, JobPlace> places_in(const std::string& token) const;
  SentMessage snapshot();
  std::optional<SentMessage> next_of(std::size_t position);
  void end(std::size_t position);

  store::JournalReader& journal_;
  store::SweepReader& sweeps_;
  Hub& hub_;
  std::int64_t sweep_;
  JobPlaces places_;             ///< of all jobs, in ascending order
  std::vector<Member> members_;  ///< parallel to places_
  std::shared_ptr<News> news_;
  std::size_t left_ = 0;  ///< jobs whose last event was not sent yet
  bool has_more_ = false;
  std::size_t bytes_since_token_ = 0;  ///< of events
  int in_turn_ = 0;                    ///< messages sent in the current job's turn
  bool snapshot_sent_ = false;
};

}  // namespace cellcrush::watch
