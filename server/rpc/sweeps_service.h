#pragma once

#include "cellcrush/v1/sweeps_service.grpc.pb.h"

namespace cellcrush::rpc {

/// Sweeps are not built: every call answers UNIMPLEMENTED and names itself.
class SweepsService final : public v1::Sweeps::Service {
 public:
  grpc::Status CreateSweep(grpc::ServerContext* context, const v1::CreateSweepRequest* request,
                           v1::Sweep* response) override;
  grpc::Status GetSweep(grpc::ServerContext* context, const v1::GetSweepRequest* request, v1::Sweep* response) override;
  grpc::Status ListSweeps(grpc::ServerContext* context, const v1::ListSweepsRequest* request,
                          v1::ListSweepsResponse* response) override;
  grpc::Status CancelSweep(grpc::ServerContext* context, const v1::CancelSweepRequest* request,
                           v1::Sweep* response) override;
  grpc::Status RetryFailedJobs(grpc::ServerContext* context, const v1::RetryFailedJobsRequest* request,
                               v1::Sweep* response) override;
  grpc::Status WatchSweep(grpc::ServerContext* context, const v1::WatchSweepRequest* request,
                          grpc::ServerWriter<v1::WatchSweepResponse>* writer) override;
  grpc::Status GetSweepTable(grpc::ServerContext* context, const v1::GetSweepTableRequest* request,
                             v1::SweepTable* response) override;
};

}  // namespace cellcrush::rpc
