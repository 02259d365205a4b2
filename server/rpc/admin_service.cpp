#include "rpc/admin_service.h"

#include "rpc/error_table.h"
#include "version.h"

namespace cellcrush::rpc {

grpc::Status AdminService::GetCapabilities(grpc::ServerContext*, const v1::GetCapabilitiesRequest*,
                                           v1::Capabilities* response) {
  return answer([&] {
    response->set_version(kSolverRevision);
    response->set_worker_limit(worker_limit_);
    return grpc::Status::OK;
  });
}

grpc::Status AdminService::GetQueue(grpc::ServerContext*, const v1::GetQueueRequest*, v1::Queue*) {
  return unimplemented("GetQueue");
}

grpc::Status AdminService::Drain(grpc::ServerContext*, const v1::DrainRequest*, v1::DrainResponse*) {
  return unimplemented("Drain");
}

}  // namespace cellcrush::rpc
