#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <string>
#include <vector>

#include "listen_address.h"

namespace cellcrush::net {

/// The sockets that listen on one address: one, or two if a name or wildcard covers IPv4 and IPv6. Not thread-safe.
class ListeningPort {
 public:
  /// Starts listening. `mode` is that of a Unix socket's file, unless systemd has opened it. Throws ServiceError
  /// (failed_precondition) if the address is in use or not permitted, naming the option that gives another.
  explicit ListeningPort(const ListenAddress& wanted, const char* option = "--listen", mode_t mode = 0600);
  /// Closes the sockets and removes the file of a Unix socket that it has made.
  ~ListeningPort();
  ListeningPort(ListeningPort&& other) noexcept;
  ListeningPort& operator=(ListeningPort&&) = delete;

  /// The address with its actual port.
  [[nodiscard]] const ListenAddress& address() const { return address_; }
  [[nodiscard]] const std::vector<int>& descriptors() const { return descriptors_; }

  /// Closes the sockets and listens on the same address again. Throws ServiceError (failed_precondition): the port then
  /// has no sockets, and reopen may be retried.
  void reopen();

 private:
  void listen_on_unix_socket();
  void listen_on_tcp();
  void listen_on(const std::string& host);
  void close_all();

  ListenAddress address_;
  const char* option_;
  mode_t mode_;
  std::vector<int> descriptors_;
  ino_t file_ = 0;  ///< inode of the Unix socket's file
};

/// Removes a stale socket at the path. Throws ServiceError (failed_precondition) if something answers there or if it is
/// not a socket.
void remove_stale_socket(const std::string& path);

/// An address as the kernel has it.
struct SocketName {
  sockaddr_storage address{};
  socklen_t size = 0;  ///< 0: none
};

/// Where to connect to a port that listens on the address: loopback if that is a wildcard.
SocketName name_of(const ListenAddress& address);

}  // namespace cellcrush::net
