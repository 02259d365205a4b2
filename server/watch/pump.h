#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "mutex.h"

namespace cellcrush::watch {

/// A few threads that serve all streams, so that a stream needs no thread of its own. A task runs soon after it is
/// scheduled, and once a second while it exists. The callers take turns, each on at most half of the threads.
/// Thread-safe.
class Pump {
 public:
  class Task {
   public:
    /// `caller`: for whom it counts.
    explicit Task(std::string caller) : caller_(std::move(caller)) {}
    virtual ~Task() = default;
    /// Does whatever needs no waiting. May run on two threads at once.
    virtual void run() = 0;

   private:
    friend class Pump;
    const std::string caller_;
    // Guarded by the pump's mutex.
    bool queued_ = false;
    bool waits_ = false;                           ///< for the next beat
    std::chrono::steady_clock::time_point woken_;  ///< last
  };

  explicit Pump(int threads);
  ~Pump() { stop(); }
  Pump(const Pump&) = delete;
  Pump& operator=(const Pump&) = delete;

  /// Runs the task once a second from now on, and whenever it is scheduled.
  void add(const std::shared_ptr<Task>& task);
  /// Quick; may be called under other locks.
  void schedule(const std::shared_ptr<Task>& task);

  /// Something has changed that the task is to tell. As `schedule`, but only once in a beat: what changes meanwhile is
  /// told together. The more tasks, the longer a beat, from a millisecond to a fifth of a second. Quick; may be
  /// called under other locks.
  void wake(const std::shared_ptr<Task>& task);

  /// Runs work of the daemon once, soon.
  void post(std::function<void()> work);

  /// Notifies the tasks that the daemon ends: they see draining() and close.
  void drain();
  [[nodiscard]] bool draining() const;

  /// Ends the threads. Tasks run no more, and those that are scheduled are dropped. Safe to repeat.
  void stop();

 private:
  /// The tasks of one caller that are to run.
  struct Line {
    std::deque<std::shared_ptr<Task>> tasks = {};
    int running = 0;
    bool has_turn = false;  ///< is among the turns
  };
  using Lines = std::map<std::string, Line>;  ///< by caller

  void work(const std::stop_token& stop);
  void tick(const std::stop_token& stop);
  [[nodiscard]] std::chrono::steady_clock::duration beat() const CELLCRUSH_REQUIRES(mutex_);
  void schedule_all();
  void push(const std::shared_ptr<Task>& task) CELLCRUSH_REQUIRES(mutex_);
  /// Lines the caller up for its next turn, if it has a task that may run.
  void line_up(Lines::iterator line) CELLCRUSH_REQUIRES(mutex_);
  void end(Lines::iterator line);

  const int most_of_caller_;  ///< threads
  mutable Mutex mutex_;
  std::condition_variable_any changed_;
  Lines lines_ CELLCRUSH_GUARDED_BY(mutex_);  ///< of callers with tasks that are to run, or run
  std::deque<Lines::iterator> turns_ CELLCRUSH_GUARDED_BY(mutex_);
  std::vector<std::weak_ptr<Task>> tasks_ CELLCRUSH_GUARDED_BY(mutex_);
  std::vector<std::shared_ptr<Task>> waiting_ CELLCRUSH_GUARDED_BY(mutex_);  ///< for the next beat
  std::condition_variable_any beaten_;                                       ///< waiting_ has its first
  bool draining_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> threads_;
};

}  // namespace cellcrush::watch
