#pragma once

#include <grpcpp/impl/codegen/service_type.h>

#include <memory>
#include <string>
#include <vector>

namespace cellcrush::rpc {

/// grpc.reflection.v1 and v1alpha, which describe the services of those full names, and themselves. They answer from
/// the descriptors that are linked here. A stream holds no thread while its client is silent. Thread-safe.
std::vector<std::unique_ptr<grpc::Service>> make_reflection_services(std::vector<std::string> names);

}  // namespace cellcrush::rpc
