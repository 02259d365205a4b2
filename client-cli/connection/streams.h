#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <string>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "command_error.h"
#include "connection/connection.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// Result of one attempt to read a stream.
struct StreamReading {
  grpc::Status status;
  bool complete = false;  ///< everything expected was received
  bool advanced = false;  ///< something new was received
};

/// A stream that can be resumed after the last message received.
struct FollowedStream {
  std::string name;  ///< of the job or sweep, for messages
  /// Opens the stream and reads it to its end. Calls `heard` for each message. The context carries no deadline.
  std::function<StreamReading(grpc::ClientContext& context, const std::function<void()>& heard)> read;
  /// The stream broke for this reason and is being resumed; called once per break.
  std::function<void(const std::string& reason)> on_break;
  /// The error for an attempt that the server refused.
  std::function<CommandError(const grpc::Status& status)> refusal;
};

/// Reads a stream until it is complete. Retries a broken attempt a few times over about ten seconds; any progress
/// resets the count. A stream that is silent for a minute counts as broken, since a live server sends something every
/// 15 s. Returns true once complete and false if `interruption` was requested. Throws CommandError: cut_off if the
/// stream stays broken, else the server's error.
bool follow_stream(const FollowedStream& stream, const Interruption& interruption);

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
