#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <string>

#include "command_error.h"
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

}  // namespace cellcrush::client
