#pragma once

#include <string>
#include <thread>
#include <vector>

#include "net/acceptor.h"
#include "net/connection_limits.h"

namespace cellcrush::net {

/// Connects to each of the daemon's own ports now and then. One that does not answer, or of which the socket's file was
/// removed, is opened again, and the log says so.
class PortProbe {
 public:
  /// `plain`: of each port whether it has no TLS. The acceptor outlives it.
  PortProbe(Acceptor& acceptor, std::vector<bool> plain, const ConnectionLimits& limits);

 private:
  void work(const std::stop_token& stop);
  void look_at(std::size_t port, const ListenAddress& address);

  Acceptor& acceptor_;
  std::vector<bool> plain_;
  ConnectionLimits limits_;
  std::string hello_;  ///< with which a client of TLS begins
  std::jthread thread_;
};

/// What a client of TLS sends first.
std::string client_hello();

/// Whether something answers on the address: sends `hello` and waits for a byte, or for the end of the connection,
/// which an acceptor that refuses it gives. True also when this process has no descriptor to find out.
bool answers(const ListenAddress& address, const std::string& hello, std::chrono::milliseconds patience);

}  // namespace cellcrush::net
