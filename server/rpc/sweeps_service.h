#pragma once

#include <string>

#include "rpc/service_parts.h"
#include "watch/sweep_source.h"

namespace cellcrush::rpc {

/// Sweeps: many jobs from one case. Thread-safe. Watches hold no thread; the pools run all other calls.
class SweepsService {
 public:
  explicit SweepsService(const ServiceParts& parts) : parts_(parts) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  // The calls; errors as exceptions, or as a status with details.
  grpc::Status create_sweep(const Call& call, const v1::CreateSweepRequest& given, v1::Sweep& response);
  grpc::Status get_sweep(const Call&, const v1::GetSweepRequest& request, v1::Sweep& response);
  grpc::Status list_sweeps(const Call& call, const v1::ListSweepsRequest& request, v1::ListSweepsResponse& response);
  grpc::Status cancel_sweep(const Call& call, const v1::CancelSweepRequest& request, v1::Sweep& response);
  grpc::Status delete_sweep(const Call& call, const v1::DeleteSweepRequest& request, v1::DeleteSweepResponse&);
  grpc::Status retry_failed_jobs(const Call& call, const v1::RetryFailedJobsRequest& request, v1::Sweep& response);
  grpc::Status get_sweep_table(const Call&, const v1::GetSweepTableRequest& request, v1::SweepTable& response);
  grpc::Status get_convergence(const Call&, const v1::GetConvergenceRequest& request, v1::Convergence& response);
  std::unique_ptr<watch::SweepSource> watch_sweep(const v1::WatchSweepRequest& request);

  struct Found {
    std::int64_t number = 0;
    v1::Sweep sweep;
  };
  /// Throws ServiceError (not_found) if there is none.
  Found find(const std::string& name);
  /// Number of a sweep that the caller may change. Also throws ServiceError (permission_denied).
  std::int64_t find_own(const Call& call, const std::string& name);

  ServiceParts parts_;
};

}  // namespace cellcrush::rpc
