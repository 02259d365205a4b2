#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

#include "access/gate.h"
#include "listen_address.h"
#include "net/connection_limits.h"

namespace cellcrush::http {

/// Serves the API over HTTP/1.1 by the Connect protocol, and the files of the web page, on a loopback port. One thread
/// serves all connections. Thread-safe.
class Gateway {
 public:
  /// Listens from construction on; `gate` and `server` outlive it. Throws ServiceError: invalid if the gate forbids the
  /// address, failed_precondition if it is in use.
  Gateway(const ListenAddress& address, const access::Gate& gate, grpc::Server& server,
          const net::ConnectionLimits& limits);
  ~Gateway();
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  /// "http://HOST:PORT" with the actual port.
  [[nodiscard]] const std::string& url() const;

  /// Closes the port and idle connections; open calls get a second to end. Safe to repeat.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush::http
