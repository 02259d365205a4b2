#pragma once

#include <grpcpp/impl/codegen/service_type.h>

#include <memory>
#include <string>
#include <vector>

#include "access/gate.h"
#include "rpc/stream_limits.h"

namespace cellcrush::rpc {

/// grpc.reflection.v1 and v1alpha: describe the named services and themselves, from the descriptors linked into this
/// program. A stream holds no thread while its client is silent, and counts against the limits. The limits and the gate
/// outlive the services. Thread-safe.
std::vector<std::unique_ptr<grpc::Service>> make_reflection_services(std::vector<std::string> names, access::Gate& gate,
                                                                     StreamLimits& limits);

}  // namespace cellcrush::rpc
