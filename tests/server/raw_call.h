#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

namespace cellcrush::testing {

/// Calls a method with hand-made bytes, so that no generated code of a package is needed. The first message of the
/// answer.
std::string call_raw(const std::shared_ptr<grpc::Channel>& channel, const std::string& method, const std::string& bytes,
                     bool stream);

/// Whether grpc.health.v1 says that the service serves.
bool is_serving(const std::shared_ptr<grpc::Channel>& channel, const std::string& service);

}  // namespace cellcrush::testing
