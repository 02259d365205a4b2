#include "net/refusing_server.h"

#include <chrono>

#include "error.h"

namespace cellcrush::net {
namespace {

constexpr int kHandshake = 2000;      // ms
constexpr int kConnectionAge = 1000;  // ms
constexpr const char* kWhy =
    "The daemon's connection limit is reached, in total or for this address (--max-connections, "
    "--max-connections-per-address). Close some connections, or try again later.";

class RefusedCall final : public grpc::ServerGenericBidiReactor {
 public:
  RefusedCall() { Finish({grpc::StatusCode::RESOURCE_EXHAUSTED, kWhy}); }
  void OnDone() override { delete this; }
};

}  // namespace

grpc::ServerGenericBidiReactor* RefusingServer::Refuse::CreateReactor(grpc::GenericCallbackServerContext*) {
  return new RefusedCall;
}

RefusingServer::RefusingServer(const std::vector<std::shared_ptr<grpc::ServerCredentials>>& credentials) {
  grpc::ServerBuilder builder;
  using External = grpc::ServerBuilder::experimental_type::ExternalConnectionType;
  for (const auto& of_port : credentials)
    ports_.push_back(builder.experimental().AddExternalConnectionAcceptor(External::FROM_FD, of_port));
  builder.RegisterCallbackGenericService(&service_);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshake);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_MS, kConnectionAge);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_GRACE_MS, kConnectionAge);
  server_ = builder.BuildAndStart();
  if (!server_) throw ServiceError(ServiceError::Kind::failed_precondition, "The gRPC server could not be started.");
}

RefusingServer::~RefusingServer() { server_->Shutdown(std::chrono::system_clock::now()); }

void RefusingServer::take(std::size_t port, int listener, int descriptor) {
  hand_over(*ports_[port], listener, descriptor);
}

void hand_over(grpc::experimental::ExternalConnectionAcceptor& port, int listener, int descriptor) {
  grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters connection;
  connection.listener_fd = listener;
  connection.fd = descriptor;
  port.HandleNewConnection(&connection);
}

}  // namespace cellcrush::net
