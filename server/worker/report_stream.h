#pragma once

#include <google/protobuf/message_lite.h>

namespace cellcrush::worker {

/// Messages over a stream socket, each preceded by its length (report.proto). The caller owns the socket. One thread
/// reads and one writes.
class ReportStream {
 public:
  explicit ReportStream(int socket) : socket_(socket) {}

  /// False when the other side is gone. Waits while the other side does not read.
  bool write(const google::protobuf::MessageLite& message);

  enum class Read {
    message,  ///< one was read
    end,      ///< the other side is gone, in the middle of a message or between two
    broken,   ///< what came is no message
  };
  /// Waits for a message.
  Read read(google::protobuf::MessageLite& message);

  /// Whether the other side says no more and all it said was read. Does not wait.
  [[nodiscard]] bool at_end() const;

 private:
  int socket_;
};

}  // namespace cellcrush::worker
