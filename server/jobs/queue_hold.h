#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mutex.h"
#include "shortage.h"

namespace cellcrush::jobs {

/// Pauses between retries of a shortage; they double from the first to the longest.
struct HoldTimes {
  std::chrono::milliseconds first{1'000};
  std::chrono::milliseconds longest{60'000};
};

/// Why no job starts at the moment.
struct Hold {
  using Clock = std::chrono::steady_clock;

  Shortage shortage = Shortage::none;
  std::string reason;                         ///< as a sentence
  Clock::time_point since;                    ///< start of the hold
  std::optional<Clock::time_point> next_try;  ///< nothing for low_disk, which is measured rather than retried
};

/// Holds the queue while the daemon lacks a resource. Two holds may exist at once: low_disk, set and released by the
/// disk check, and a trouble that a slot met. After a pause one job starts as a trial. The trouble is over once it
/// runs; if the trial meets trouble again, the next pause is twice as long. Thread-safe.
class QueueHold {
 public:
  using Now = std::function<Hold::Clock::time_point()>;
  /// Called after each change with the current holds; the last call has the newest. Must not call back.
  using Changed = std::function<void(const std::vector<Hold>&)>;

  /// `queue`: how the log names it.
  explicit QueueHold(const HoldTimes& times, Changed changed = {}, Now now = Hold::Clock::now,
                     std::string queue = "The queue");

  /// Sets the hold for low_disk, or releases it if `reason` is absent. Returns whether this is a change.
  bool set_low_disk(const std::optional<std::string>& reason);

  /// Whether a job may start: nothing holds the queue, or the pause is over and no trial runs.
  [[nodiscard]] bool is_open() const;

  /// Announces that a job starts. Returns whether it is the trial. REQUIRES: is_open, with no other thread in between.
  bool begin_start();

  /// Announces that a job runs: the trouble is over.
  void succeeded();

  /// Announces that a job ran to its end: pauses start from the first again.
  void proven();

  /// Signals that this shortage may be over: if it holds the queue, the next trial starts at once.
  void try_now(Shortage shortage);

  /// Announces trouble in a slot.
  void failed(const Trouble& trouble);

  /// The trial has ended. If it neither succeeded nor failed because its job was withdrawn, another trial may start at
  /// once.
  void end_trial();

  /// When is_open may become true without an event; nothing if it cannot.
  [[nodiscard]] std::optional<Hold::Clock::time_point> next_try() const;

  /// The current holds, low_disk first.
  [[nodiscard]] std::vector<Hold> holds() const;

 private:
  void tell();

  std::string queue_;
  HoldTimes times_;
  Changed changed_;
  Now now_;
  Mutex telling_;  ///< acquired before mutex_
  mutable Mutex mutex_;
  std::optional<Hold> low_disk_ CELLCRUSH_GUARDED_BY(mutex_);
  std::optional<Hold> trouble_ CELLCRUSH_GUARDED_BY(mutex_);
  bool trial_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  /// Pause before the next trial, or the last one before the trouble ended.
  std::chrono::milliseconds pause_ CELLCRUSH_GUARDED_BY(mutex_){0};
  Hold::Clock::time_point over_ CELLCRUSH_GUARDED_BY(mutex_);  ///< end of the trouble
};

}  // namespace cellcrush::jobs
