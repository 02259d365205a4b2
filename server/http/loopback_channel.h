#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>

namespace cellcrush::http {

/// A channel to the daemon's own gRPC server, over a pair of sockets of its own. gRPC's in-process channel would need
/// none, but version 1.51 now and then never ends a cancelled stream of it, and the server then never stops. Throws
/// ServiceError (exhausted) if no descriptors are left.
std::shared_ptr<grpc::Channel> connect_to(grpc::Server& server);

}  // namespace cellcrush::http
