#pragma once

#include <grpcpp/security/auth_metadata_processor.h>
#include <grpcpp/security/server_credentials.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "access/tls_files.h"

namespace cellcrush::access {

/// TLS whose certificates and authority may change while a server listens: each handshake uses those that the source
/// gives then, and connections that are open stay. grpc::SslServerCredentials keeps the ones it was made with. Outlives
/// the servers that use it.
class TlsCredentials final : public grpc::ServerCredentials {
 public:
  /// Called for each handshake, by any thread; never null, and the same object as long as nothing has changed. Whether
  /// it has a client authority does not change.
  using Source = std::function<std::shared_ptr<const TlsFiles>()>;

  explicit TlsCredentials(Source source);
  ~TlsCredentials() override;

  /// `processor` sees every call before a service does; it does not block (IsBlocking is false).
  void SetAuthMetadataProcessor(const std::shared_ptr<grpc::AuthMetadataProcessor>& processor) override;

 private:
  struct Port;

  int AddPortToServer(const std::string& address, grpc_server* server) override;

  Source source_;
  std::shared_ptr<grpc::AuthMetadataProcessor> processor_;
  std::vector<std::unique_ptr<Port>> ports_;
};

}  // namespace cellcrush::access
