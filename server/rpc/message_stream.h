#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <optional>
#include <string>

#include "watch/pump.h"

namespace cellcrush::rpc {

/// One open stream for a caller that is not gRPC. It gives encoded messages when it is asked for them, and so holds at
/// most one batch. The pump's threads make the batches. Thread-safe.
class MessageStream : public watch::Pump::Task {
 public:
  /// Appends a message as it goes out. May throw ServiceError.
  using Encode = std::function<void(const google::protobuf::Message& message, std::string& to)>;

  /// Some messages, in order.
  struct Batch {
    std::string bytes;
    std::optional<grpc::Status> end;  ///< how the stream ended; nothing follows
  };
  /// Called on a thread of the pump, without a lock: must be quick.
  using Deliver = std::function<void(Batch batch)>;

  /// Asks for the next batch, which is delivered once there is one. REQUIRES: the batch before it was delivered.
  virtual void ask(Deliver deliver) = 0;

  /// Ends the stream: quick, as a thread of the pump closes it. Nothing is delivered any more, except what is being
  /// delivered now. Safe to repeat.
  virtual void cancel() = 0;
};

}  // namespace cellcrush::rpc
