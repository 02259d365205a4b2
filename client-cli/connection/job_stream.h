#pragma once

#include <functional>
#include <string>

#include "cellcrush/v1/event.pb.h"
#include "connection/connection.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// What a watcher of a job is told, on the thread that follows it.
class JobWatcher {
 public:
  virtual ~JobWatcher() = default;
  virtual void on_event(const v1::JobEvent& event) = 0;
  /// The stream broke for the reason given and is being picked up again.
  virtual void on_break(const std::string& reason) = 0;
};

/// Follows a job from its first event to its last. A stream that breaks is picked up behind the last event that came, a
/// few times over about ten seconds; a stream that is silent for a minute counts as broken, since a live server sends
/// something every 15 s. Returns true at the job's end and false when `interruption` was requested. Throws
/// CommandError: cut_off when the stream stays broken, else what the server says.
bool follow_job(Connection& connection, const std::string& name, bool frames, const Interruption& interruption,
                JobWatcher& watcher);

}  // namespace cellcrush::client
