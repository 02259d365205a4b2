#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mutex.h"
#include "shortage.h"

namespace cellcrush::jobs {

/// Pauses before a shortage is tried again: they double from the first to the longest.
struct HoldTimes {
  std::chrono::milliseconds first{1'000};
  std::chrono::milliseconds longest{60'000};
};

/// Why no job starts at the moment.
struct Hold {
  using Clock = std::chrono::steady_clock;

  Shortage shortage = Shortage::none;
  std::string reason;                         ///< a sentence
  Clock::time_point since;                    ///< when the queue began to be held
  std::optional<Clock::time_point> next_try;  ///< nothing for low_disk, which is measured and not tried
};

/// Holds the queue while the daemon lacks something. There are two holds, which may stand at once: low_disk, set and
/// released by whoever measures the disk, and trouble, which a slot met. After a pause one job is started as a trial:
/// once it runs, the trouble is over; if the trial meets trouble again, the next pause is twice as long. Thread-safe.
class QueueHold {
 public:
  using Now = std::function<Hold::Clock::time_point()>;
  /// Called after each change with the holds that stand, the last call with the newest; must not call back.
  using Changed = std::function<void(const std::vector<Hold>&)>;

  explicit QueueHold(const HoldTimes& times, Changed changed = {}, Now now = Hold::Clock::now);

  /// Sets the hold for low_disk, or takes it away where there is no reason. Whether that is a change.
  bool set_low_disk(const std::optional<std::string>& reason);

  /// Whether a job may start: nothing holds the queue, or the pause is over and there is no trial yet.
  [[nodiscard]] bool is_open() const;

  /// A job is about to start. Whether it is the trial. REQUIRES: is_open, and no other thread between the two.
  bool begin_start();

  /// A job runs: there is no trouble any more.
  void succeeded();

  /// A job ran to its end: the pauses begin again with the first.
  void proven();

  /// There are signs that this shortage is over: where it holds the queue it is tried at once.
  void try_now(Shortage shortage);

  /// A slot met trouble.
  void failed(const Trouble& trouble);

  /// The trial has ended. Where it neither succeeded nor failed, as its job was withdrawn, another job may be tried at
  /// once.
  void end_trial();

  /// When is_open may become true without a change; nothing while it cannot.
  [[nodiscard]] std::optional<Hold::Clock::time_point> next_try() const;

  /// What holds the queue now, low_disk first.
  [[nodiscard]] std::vector<Hold> holds() const;

 private:
  void tell();

  HoldTimes times_;
  Changed changed_;
  Now now_;
  Mutex telling_;  ///< held before mutex_ is
  mutable Mutex mutex_;
  std::optional<Hold> low_disk_ CELLCRUSH_GUARDED_BY(mutex_);
  std::optional<Hold> trouble_ CELLCRUSH_GUARDED_BY(mutex_);
  bool trial_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  /// Before the next trial, or the last one before the trouble was over.
  std::chrono::milliseconds pause_ CELLCRUSH_GUARDED_BY(mutex_){0};
  Hold::Clock::time_point over_ CELLCRUSH_GUARDED_BY(mutex_);  ///< when it was
};

}  // namespace cellcrush::jobs
