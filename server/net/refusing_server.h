#pragma once

#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/grpcpp.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace cellcrush::net {

/// Answers every call on connections beyond the limits with RESOURCE_EXHAUSTED and the reason, and closes them a second
/// later. A gRPC client hides why a connection was closed and keeps reconnecting, but shows a status. Thread-safe.
class RefusingServer {
 public:
  /// One port per credentials object. Throws ServiceError (failed_precondition) if it cannot start.
  explicit RefusingServer(const std::vector<std::shared_ptr<grpc::ServerCredentials>>& credentials);
  ~RefusingServer();
  RefusingServer(const RefusingServer&) = delete;
  RefusingServer& operator=(const RefusingServer&) = delete;

  /// Takes ownership of a connected socket, non-blocking and close-on-exec.
  void take(std::size_t port, int listener, int descriptor);

 private:
  class Refuse final : public grpc::CallbackGenericService {
    grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;
  };

  Refuse service_;
  std::vector<std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor>> ports_;
  std::unique_ptr<grpc::Server> server_;
};

/// Hands a connected socket to gRPC.
void hand_over(grpc::experimental::ExternalConnectionAcceptor& port, int listener, int descriptor);

}  // namespace cellcrush::net
