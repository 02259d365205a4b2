#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <string_view>

#include "error.h"

namespace cellcrush::rpc {

/// The error of a request that cannot be parsed, naming the method and the message type. `path` is as gRPC has it:
/// "/cellcrush.v1.Jobs/GetJob".
InvalidField parse_error(std::string_view path);

/// Ends a unary or server-streaming call whose request cannot be parsed with parse_error. gRPC itself would end it with
/// INTERNAL or UNIMPLEMENTED and no message.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_parse_error_interceptors();

}  // namespace cellcrush::rpc
