#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "access/gate.h"
#include "http/public_url.h"
#include "listen_address.h"
#include "net/connection_limits.h"
#include "rpc/health_service.h"
#include "rpc/method_table.h"

namespace cellcrush::http {

/// Serves the API over HTTP/1.1 by the Connect protocol, and the files of the web page; with TLS if the gate has its
/// files. One thread serves all connections. Thread-safe.
class Gateway {
 public:
  /// Listens from construction on, on an address that the gate permits. `methods` answers the calls, `received` counts
  /// the bodies of requests, `board` answers /healthz and /readyz; they and `gate` outlive it. Pages of
  /// `framing_origins` may frame the web page. Browsers may ask for `public_url`. Throws ServiceError:
  /// failed_precondition if the address is in use, invalid if OpenSSL refuses the files of TLS.
  Gateway(const ListenAddress& address, const access::Gate& gate, const rpc::MethodTable& methods,
          rpc::Accounts& received, const rpc::HealthBoard& board, const net::ConnectionLimits& limits,
          const std::vector<std::string>& framing_origins = {}, const PublicUrl& public_url = {});
  ~Gateway();
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  /// "http://HOST:PORT", or "https://HOST:PORT", with the actual port.
  [[nodiscard]] const std::string& url() const;

  /// Runs the work soon on the thread of all connections.
  void post(std::function<void()> work);

  /// Closes the port and idle connections; open calls get a second to end. Safe to repeat.
  void stop();

 private:
  class TlsContext;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush::http
