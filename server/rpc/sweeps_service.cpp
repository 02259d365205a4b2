#include "rpc/sweeps_service.h"

#include "rpc/error_table.h"

namespace cellcrush::rpc {

grpc::Status SweepsService::CreateSweep(grpc::ServerContext*, const v1::CreateSweepRequest*, v1::Sweep*) {
  return unimplemented("CreateSweep");
}

grpc::Status SweepsService::GetSweep(grpc::ServerContext*, const v1::GetSweepRequest*, v1::Sweep*) {
  return unimplemented("GetSweep");
}

grpc::Status SweepsService::ListSweeps(grpc::ServerContext*, const v1::ListSweepsRequest*, v1::ListSweepsResponse*) {
  return unimplemented("ListSweeps");
}

grpc::Status SweepsService::CancelSweep(grpc::ServerContext*, const v1::CancelSweepRequest*, v1::Sweep*) {
  return unimplemented("CancelSweep");
}

grpc::Status SweepsService::RetryFailedJobs(grpc::ServerContext*, const v1::RetryFailedJobsRequest*, v1::Sweep*) {
  return unimplemented("RetryFailedJobs");
}

grpc::Status SweepsService::WatchSweep(grpc::ServerContext*, const v1::WatchSweepRequest*,
                                       grpc::ServerWriter<v1::WatchSweepResponse>*) {
  return unimplemented("WatchSweep");
}

grpc::Status SweepsService::GetSweepTable(grpc::ServerContext*, const v1::GetSweepTableRequest*, v1::SweepTable*) {
  return unimplemented("GetSweepTable");
}

}  // namespace cellcrush::rpc
