#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <optional>
#include <string>

namespace cellcrush::rpc {

/// The answers to one call that did not come over gRPC: those of a stream, or the only one of a unary call. It gives
/// encoded messages when it is asked for them, and so holds at most one batch. Thread-safe.
class MessageStream {
 public:
  virtual ~MessageStream() = default;

  /// Appends a message as it goes out. May throw ServiceError.
  using Encode = std::function<void(const google::protobuf::Message& message, std::string& to)>;

  /// Some messages, in order.
  struct Batch {
    std::string bytes;
    std::optional<grpc::Status> end;  ///< how the stream ended; nothing follows
  };
  /// Called on the thread that made the batch, without a lock: must be quick.
  using Deliver = std::function<void(Batch batch)>;

  /// Asks for the next batch, which is delivered once there is one. REQUIRES: the batch before it was delivered.
  virtual void ask(Deliver deliver) = 0;

  /// Nobody waits for what follows. Quick; safe to repeat. A stream delivers nothing any more, except what is being
  /// delivered now; a unary call still ends with a batch.
  virtual void cancel() = 0;
};

}  // namespace cellcrush::rpc
