#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>

namespace cellcrush::rpc {

/// Ends a unary or server-streaming call whose request cannot be parsed with INVALID_ARGUMENT, naming the method and
/// the message type. gRPC itself would end it with INTERNAL or UNIMPLEMENTED and no message.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_parse_error_interceptors();

}  // namespace cellcrush::rpc
