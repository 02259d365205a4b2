#pragma once

#include <chrono>
#include <string>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// Catches the first Ctrl-C (SIGINT) or SIGTERM while it lives, so that a watch can end properly. A second one, half a
/// second later or more, ends the program as usual. At most one may exist at a time. wait_for may be called from any
/// thread.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Waits at most `time` for a signal, or until the descriptor `over` is readable; returns whether a signal has
  /// arrived, now or before.
  [[nodiscard]] bool wait_for(std::chrono::milliseconds time, int over = -1) const;

  [[nodiscard]] bool requested() const { return wait_for(std::chrono::milliseconds(0)); }
};

/// Callbacks for a watcher of a job or a sweep, on the thread that follows it.
template <typename Event>
class Watcher {
 public:
  virtual ~Watcher() = default;
  virtual void on_event(const Event& event) = 0;
  /// The stream broke for this reason and is being resumed; called once per break.
  virtual void on_break(const std::string& reason) = 0;
};

/// Follows a job from its first event to its last. Resumes a broken stream after the last event received, a few times
/// over about ten seconds; any progress resets the count. A stream that is silent for a minute counts as broken, since
/// a live server sends something every 15 s. Returns true at the job's end and false if `interruption` was requested.
/// Throws CommandError: cut_off if the stream stays broken, else the server's error.
bool follow_job(Connection& connection, const std::string& name, const Interruption& interruption,
                Watcher<v1::JobEvent>& watcher);

/// The same for a sweep, until all its jobs have ended.
bool follow_sweep(Connection& connection, const std::string& name, const Interruption& interruption,
                  Watcher<v1::WatchSweepResponse>& watcher);

}  // namespace cellcrush::client
