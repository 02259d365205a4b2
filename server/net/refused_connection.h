#pragma once

#include <chrono>
#include <deque>
#include <string>

namespace cellcrush::net {

/// Connections that were refused and are still open for a moment, so that the reason reaches the client: closed at once, what
/// was sent would be lost with the client's unread bytes. Not thread-safe.
class RefusedConnections {
 public:
  using Clock = std::chrono::steady_clock;

  RefusedConnections() = default;
  ~RefusedConnections();
  RefusedConnections(const RefusedConnections&) = delete;
  RefusedConnections& operator=(const RefusedConnections&) = delete;

  /// Sends the reason as a GOAWAY of HTTP/2 (RFC 9113, 6.8), ends the sending side, and closes the descriptor later.
  void add(int descriptor, const std::string& reason);

  /// Closes those whose moment is over.
  void close_old();

  [[nodiscard]] bool is_empty() const { return open_.empty(); }

 private:
  struct Open {
    int descriptor;
    Clock::time_point since;
  };
  void close_first();

  std::deque<Open> open_;
};

}  // namespace cellcrush::net
