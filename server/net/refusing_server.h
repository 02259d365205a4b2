#pragma once

#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/grpcpp.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace cellcrush::net {

/// Answers every call on connections beyond the limits with RESOURCE_EXHAUSTED and the reason, and ends these
/// connections a second later. A client of gRPC shows nobody why a connection was closed, and connects again and again;
/// a status it shows. Thread-safe.
class RefusingServer {
 public:
  /// One port for each of the credentials. Throws ServiceError (failed_precondition) when it cannot be started.
  explicit RefusingServer(const std::vector<std::shared_ptr<grpc::ServerCredentials>>& credentials);
  ~RefusingServer();
  RefusingServer(const RefusingServer&) = delete;
  RefusingServer& operator=(const RefusingServer&) = delete;

  /// Takes a connected socket, non-blocking and close-on-exec.
  void take(std::size_t port, int listener, int descriptor);

 private:
  class Refuse final : public grpc::CallbackGenericService {
    grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;
  };

  Refuse service_;
  std::vector<std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor>> ports_;
  std::unique_ptr<grpc::Server> server_;
};

/// Hands a connected socket over to gRPC.
void hand_over(grpc::experimental::ExternalConnectionAcceptor& port, int listener, int descriptor);

}  // namespace cellcrush::net
