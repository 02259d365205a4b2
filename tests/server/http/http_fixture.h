#pragma once

#include <string>
#include <vector>

#include "server/gate_fixture.h"
#include "server/http/http_socket.h"

namespace cellcrush::testing {

/// Sends a request with TLS and reads to the end of the answer, at most 60 s; empty if either side refuses the other.
/// `latest`: the latest version of TLS that the client speaks; 0: any.
std::string exchange_with_tls(int port, const Visitor& visitor, const std::string& request, int latest = 0);

/// A message of a stream of the Connect protocol, as its specification has it: a byte of flags, four of the length.
std::string envelope(const std::string& message, char flags = 0);

/// The body of a chunked answer.
std::string dechunked(const std::string& answer);

/// The messages in the body of a stream, without the last one, which tells how it ended.
std::vector<std::string> messages_of(const std::string& body);

/// A daemon that serves HTTP on a free port of loopback, and what a client sends it. Each test starts the daemon.
class HttpFixture : public GateFixture {
 protected:
  [[nodiscard]] DaemonOptions http_options() const;
  [[nodiscard]] int port() const;

  [[nodiscard]] std::string request(const std::string& line, const std::string& headers,
                                    const std::string& body = "") const;
  /// Sends it on a connection of its own. The answer.
  [[nodiscard]] std::string exchange(const std::string& text) const;
  /// A request for a method of Jobs.
  [[nodiscard]] std::string call_text(const std::string& method, const std::string& type, const std::string& body,
                                      const std::string& headers = "") const;
  [[nodiscard]] std::string call(const std::string& method, const std::string& type, const std::string& body,
                                 const std::string& headers = "") const;
  /// The header with the token of that name.
  [[nodiscard]] std::string token_of(const std::string& name) const;
};

}  // namespace cellcrush::testing
