#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <string>

#include "command_error.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// What one reading of a stream came to.
struct StreamReading {
  grpc::Status status;
  bool complete = false;  ///< everything that was to come has come
  bool advanced = false;  ///< something came that no reading before had
};

/// A stream that may be read again behind what has come already.
struct FollowedStream {
  std::string name;  ///< of the job or sweep, for messages
  /// Opens the stream and reads it to its end. It calls `heard` for each message. The context carries no deadline.
  std::function<StreamReading(grpc::ClientContext& context, const std::function<void()>& heard)> read;
  /// The stream broke for the reason given and is being picked up again; called once a break.
  std::function<void(const std::string& reason)> on_break;
  /// The error for a reading that the server refused.
  std::function<CommandError(const grpc::Status& status)> refusal;
};

/// Reads a stream until it is complete. A reading that breaks is repeated a few times over about ten seconds, and from
/// the start of that count whenever it advanced; a stream that is silent for a minute counts as broken, since a live
/// server sends something every 15 s. Returns true once complete and false when `interruption` was requested. Throws
/// CommandError: cut_off when the stream stays broken, else what the server says.
bool follow_stream(const FollowedStream& stream, const Interruption& interruption);

}  // namespace cellcrush::client
