#pragma once

#include <string>

#include "cellcrush/v1/sweeps_service.pb.h"
#include "connection/connection.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// Callbacks for a watcher of a sweep, on the thread that follows it.
class SweepWatcher {
 public:
  virtual ~SweepWatcher() = default;
  virtual void on_response(const v1::WatchSweepResponse& response) = 0;
  /// The stream broke for this reason and is being resumed.
  virtual void on_break(const std::string& reason) = 0;
};

/// Follows a sweep until all its jobs have ended. Resumes a broken stream with its last token (see follow_stream).
/// Returns true at the sweep's end and false if `interruption` was requested. Throws CommandError.
bool follow_sweep(Connection& connection, const std::string& name, const Interruption& interruption,
                  SweepWatcher& watcher);

}  // namespace cellcrush::client
