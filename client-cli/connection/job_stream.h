#pragma once

#include <functional>
#include <string>

#include "cellcrush/v1/event.pb.h"
#include "connection/connection.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// Callbacks for a watcher of a job, on the thread that follows it.
class JobWatcher {
 public:
  virtual ~JobWatcher() = default;
  virtual void on_event(const v1::JobEvent& event) = 0;
  /// The stream broke for this reason and is being resumed.
  virtual void on_break(const std::string& reason) = 0;
};

/// Follows a job from its first event to its last. Resumes a broken stream after the last event received, a few times
/// over about ten seconds. A stream that is silent for a minute counts as broken, since a live server sends something
/// every 15 s. Returns true at the job's end and false if `interruption` was requested. Throws CommandError: cut_off if
/// the stream stays broken, else the server's error.
bool follow_job(Connection& connection, const std::string& name, bool frames, const Interruption& interruption,
                JobWatcher& watcher);

}  // namespace cellcrush::client
