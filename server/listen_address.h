#pragma once

#include <string>
#include <string_view>

namespace cellcrush {

/// Where the daemon listens: a socket in the file system, or a port of one of this machine's addresses.
struct ListenAddress {
  enum class Kind { unix_socket, tcp };
  Kind kind = Kind::tcp;
  std::string place;  ///< absolute path of the socket, or host
  int port = 0;       ///< 0: any free port

  /// In the form of --listen: "unix:PATH" or "HOST:PORT".
  [[nodiscard]] std::string text() const;

  /// Whether only this machine can reach it: a socket or a loopback address.
  [[nodiscard]] bool is_loopback() const;
};

/// Reads "unix:PATH" or "HOST:PORT", where the host is "localhost", an IPv4 address or an IPv6 address in brackets.
/// Throws ServiceError (invalid) for anything else, and for a path too long for a socket. `use`: what to use instead.
ListenAddress parse_listen_address(std::string_view text, const std::string& use = "unix:PATH or HOST:PORT");

}  // namespace cellcrush
