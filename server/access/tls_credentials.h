#pragma once

#include <grpcpp/security/auth_metadata_processor.h>
#include <grpcpp/security/server_credentials.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "access/tls_files.h"

namespace cellcrush::access {

/// TLS credentials that can change while a server listens. Each handshake asks `source` for the current certificates
/// and authority; open connections are unaffected. grpc::SslServerCredentials cannot change. Outlives the servers that
/// use it.
class TlsCredentials final : public grpc::ServerCredentials {
 public:
  /// Called for each handshake, by any thread. Never returns null, and returns the same object until something changes.
  /// Whether it has a client authority never changes.
  using Source = std::function<std::shared_ptr<const TlsFiles>()>;

  explicit TlsCredentials(Source source);
  ~TlsCredentials() override;

  /// `processor` checks every call before it reaches a service. It must not block (IsBlocking is false).
  void SetAuthMetadataProcessor(const std::shared_ptr<grpc::AuthMetadataProcessor>& processor) override;

 private:
  struct Port;

  int AddPortToServer(const std::string& address, grpc_server* server) override;

  Source source_;
  std::shared_ptr<grpc::AuthMetadataProcessor> processor_;
  std::vector<std::unique_ptr<Port>> ports_;
};

}  // namespace cellcrush::access
