#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace cellcrush {

/// Watches whether the loops of the daemon make progress. Each loop is asked on a thread of its own, so that a stuck
/// one holds up nothing else. Time in which the whole process stands still, as after SIGSTOP, does not count.
class Heartbeats {
 public:
  /// A beat of the loop, on any thread, at any time.
  using Beat = std::function<void()>;

  struct Loop {
    std::string name;  ///< as a sentence begins: "The journal"
    /// Has the loop do a small piece of work and beat then. Asked again once it has. Throws if the loop cannot work.
    std::function<void(Beat beat)> ask;
    int patience = 1;  ///< times Times::patience, for a loop with long pieces of work
  };

  struct Times {
    std::chrono::milliseconds interval{1'000};  ///< between two rounds
    int patience = 10;                          ///< rounds without a beat after which a loop is stuck
  };

  /// Receives in each round which loops are stuck, in sentences; empty: none.
  using Tell = std::function<void(const std::string& stuck)>;

  /// Logs when a loop gets stuck, and when it moves again.
  Heartbeats(std::vector<Loop> loops, const Times& times, Tell tell);
  /// Waits for an `ask` that has not returned.
  ~Heartbeats() = default;
  Heartbeats(const Heartbeats&) = delete;
  Heartbeats& operator=(const Heartbeats&) = delete;

 private:
  struct Pulse {
    std::string name;
    int patience = 0;  ///< rounds
    std::atomic<int> missed = 0;
    std::atomic<bool> is_asked = false;
    std::atomic<std::chrono::system_clock::time_point> last = std::chrono::system_clock::now();
    bool is_stuck = false;  ///< of the watching thread
  };

  void watch(const std::stop_token& stop) const;

  Times times_;
  Tell tell_;
  std::vector<std::shared_ptr<Pulse>> pulses_;  ///< shared with beats, which may come late
  std::vector<std::jthread> threads_;
};

}  // namespace cellcrush
