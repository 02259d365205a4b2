#pragma once

#include <string>
#include <thread>
#include <vector>

#include "net/acceptor.h"
#include "net/connection_limits.h"

namespace cellcrush::net {

/// Periodically connects to each of the daemon's own ports. Reopens a port that does not answer, or whose socket file
/// was removed, and logs it.
class PortProbe {
 public:
  /// `plain`: for each port, whether it lacks TLS. The acceptor outlives it.
  PortProbe(Acceptor& acceptor, std::vector<bool> plain, const ConnectionLimits& limits);

 private:
  void work(const std::stop_token& stop);
  void check_port(std::size_t port, const ListenAddress& address);

  Acceptor& acceptor_;
  std::vector<bool> plain_;
  ConnectionLimits limits_;
  std::string hello_;  ///< first message of a TLS client
  std::jthread thread_;
};

/// The first message of a TLS client.
std::string client_hello();

/// Whether something answers on the address: sends `hello` and waits for a byte or the end of the connection. An
/// acceptor that refuses the connection ends it. Also true if this process has no descriptor for the test.
bool answers(const ListenAddress& address, const std::string& hello, std::chrono::milliseconds patience);

}  // namespace cellcrush::net
