#pragma once

#include <string>
#include <string_view>

namespace cellcrush {

/// Where the daemon listens: a socket in the file system, or a port of this machine's loopback interface.
struct ListenAddress {
  enum class Kind { unix_socket, tcp };
  Kind kind = Kind::tcp;
  std::string place;  ///< absolute path of the socket, or host
  int port = 0;       ///< 0: one that is free

  /// In the form of --listen: "unix:PATH" or "HOST:PORT".
  [[nodiscard]] std::string text() const;
};

/// Reads "unix:PATH" or "HOST:PORT". Throws ServiceError (invalid) for anything else, for a path too long for a socket,
/// and for a host that is not loopback: calls are not authenticated, so nobody else may reach them.
ListenAddress parse_listen_address(std::string_view text);

/// Removes what an ended daemon left at the path. Throws ServiceError (failed_precondition) when something answers
/// there or when it is no socket.
void remove_stale_socket(const std::string& path);

}  // namespace cellcrush
