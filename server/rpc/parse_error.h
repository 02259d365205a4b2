#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>

namespace cellcrush::rpc {

/// Gives a unary or server-streaming call whose request cannot be parsed INVALID_ARGUMENT, with the method and the type
/// of message in words. gRPC itself ends it with INTERNAL or UNIMPLEMENTED and no words.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_parse_error_interceptors();

}  // namespace cellcrush::rpc
