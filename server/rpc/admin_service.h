#pragma once

#include "cellcrush/v1/admin_service.grpc.pb.h"

namespace cellcrush::rpc {

/// What the daemon is and can do. Thread-safe.
class AdminService final : public v1::Admin::Service {
 public:
  explicit AdminService(int worker_limit) : worker_limit_(worker_limit) {}

  grpc::Status GetCapabilities(grpc::ServerContext* context, const v1::GetCapabilitiesRequest* request,
                               v1::Capabilities* response) override;
  grpc::Status GetQueue(grpc::ServerContext* context, const v1::GetQueueRequest* request, v1::Queue* response) override;
  grpc::Status Drain(grpc::ServerContext* context, const v1::DrainRequest* request,
                     v1::DrainResponse* response) override;

 private:
  int worker_limit_;
};

}  // namespace cellcrush::rpc
