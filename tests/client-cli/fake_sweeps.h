#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "cellcrush/v1/sweeps_service.grpc.pb.h"

namespace cellcrush::client::testing {

/// What the service of sweeps answers.
struct SweepScript {
  v1::Sweep sweep;  ///< known under its name, others are NOT_FOUND; without a name the service is UNIMPLEMENTED
  std::vector<v1::WatchSweepResponse> responses;  ///< of a watch, behind the snapshot
  int cut_streams = 0;                            ///< so many watches end with UNAVAILABLE
  std::size_t responses_before_cut = 5;           ///< of one watch
  bool hold = false;                              ///< a watch stays open behind the last response
  v1::SweepTable table;
  v1::Convergence convergence;
};

/// What the service was asked.
struct AskedOfSweeps {
  std::vector<v1::CreateSweepRequest> creates;
  std::vector<std::string> tokens;  ///< of the watches
  std::vector<v1::ListSweepsRequest> lists;
  std::vector<std::string> cancelled;
  std::vector<std::string> deleted;
  std::vector<std::string> retried;
};

class FakeSweeps : public v1::Sweeps::Service {
 public:
  explicit FakeSweeps(SweepScript script);

  [[nodiscard]] AskedOfSweeps asked() const;

  grpc::Status CreateSweep(grpc::ServerContext*, const v1::CreateSweepRequest* request, v1::Sweep* response) override;
  grpc::Status GetSweep(grpc::ServerContext*, const v1::GetSweepRequest* request, v1::Sweep* response) override;
  grpc::Status ListSweeps(grpc::ServerContext*, const v1::ListSweepsRequest* request,
                          v1::ListSweepsResponse* response) override;
  grpc::Status CancelSweep(grpc::ServerContext*, const v1::CancelSweepRequest* request, v1::Sweep* response) override;
  grpc::Status DeleteSweep(grpc::ServerContext*, const v1::DeleteSweepRequest* request,
                           v1::DeleteSweepResponse* response) override;
  grpc::Status RetryFailedJobs(grpc::ServerContext*, const v1::RetryFailedJobsRequest* request,
                               v1::Sweep* response) override;
  grpc::Status WatchSweep(grpc::ServerContext* context, const v1::WatchSweepRequest* request,
                          grpc::ServerWriter<v1::WatchSweepResponse>* writer) override;
  grpc::Status GetSweepTable(grpc::ServerContext*, const v1::GetSweepTableRequest* request,
                             v1::SweepTable* response) override;
  grpc::Status GetConvergence(grpc::ServerContext*, const v1::GetConvergenceRequest* request,
                              v1::Convergence* response) override;

 private:
  [[nodiscard]] grpc::Status find(const std::string& name) const;

  SweepScript script_;
  mutable std::mutex mutex_;  ///< guards the two below
  AskedOfSweeps asked_;
  int cuts_left_ = 0;
};

/// A sweep "sweeps/test" over speed, a job for each of `ends`: 50, 100, 150 ... m/s. Its jobs run one after the other
/// to these states; the table has plateaus of 0.3 + 0.0003 V^2 at the impact plate for those that succeed.
SweepScript make_sweep_script(const std::vector<v1::Job::State>& ends);

}  // namespace cellcrush::client::testing
