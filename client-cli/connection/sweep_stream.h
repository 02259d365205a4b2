#pragma once

#include <string>

#include "cellcrush/v1/sweeps_service.pb.h"
#include "connection/connection.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// What a watcher of a sweep is told, on the thread that follows it.
class SweepWatcher {
 public:
  virtual ~SweepWatcher() = default;
  virtual void on_response(const v1::WatchSweepResponse& response) = 0;
  /// The stream broke for the reason given and is being picked up again.
  virtual void on_break(const std::string& reason) = 0;
};

/// Follows a sweep until all its jobs have ended. A stream that breaks is picked up by the token that came last, as
/// follow_stream says. Returns true at the sweep's end and false when `interruption` was requested. Throws
/// CommandError.
bool follow_sweep(Connection& connection, const std::string& name, const Interruption& interruption,
                  SweepWatcher& watcher);

}  // namespace cellcrush::client
