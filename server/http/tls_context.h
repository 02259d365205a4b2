#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>

#include "access/gate.h"

namespace cellcrush::http {

/// TLS for new connections, with the files that the gate has read last. Not thread-safe.
class TlsContext {
 public:
  /// `gate` outlives it. Throws ServiceError (invalid) if OpenSSL refuses the files.
  explicit TlsContext(const access::Gate& gate);

  /// Null without TLS. If OpenSSL refuses changed files, logs it, and the previous ones stay in force.
  boost::asio::ssl::context* current();

 private:
  const access::Gate& gate_;
  std::shared_ptr<const access::TlsFiles> files_;  ///< looked at last
  std::unique_ptr<boost::asio::ssl::context> context_;
};

}  // namespace cellcrush::http
