#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/admin_service.pb.h"
#include "jobs/queue_forecast.h"
#include "rpc/service_parts.h"

namespace cellcrush::rpc {

/// State and control of the daemon, and the waiting jobs of all executors. Thread-safe.
class AdminService {
 public:
  /// `drain`: called once a client has asked for it.
  AdminService(const ServiceParts& parts, std::function<void()> drain)
      : parts_(parts), drain_daemon_(std::move(drain)) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  grpc::Status get_capabilities(const Call&, const v1::GetCapabilitiesRequest&, v1::Capabilities& response);
  grpc::Status get_queue(const Call&, const v1::GetQueueRequest&, v1::Queue& response);
  grpc::Status drain(const Call& call, const v1::DrainRequest&, v1::DrainResponse&);

  /// Jobs of one executor.
  struct Jobs {
    std::vector<jobs::RunningJob> running;  ///< or with the executor, which has not started them
    std::vector<store::QueuedJob> waiting;
  };

  /// Throws ServiceError if the journal cannot be read.
  v1::Queue list_queues();
  /// Jobs that the executor has, and entries for those that it has not started.
  Jobs jobs_of(const std::string& executor, v1::Queue& out);
  jobs::RunningJob running_job(const store::QueuedJob& job, v1::Job::State state);
  jobs::JobFacts facts_of(std::int64_t job);
  void add_queue(const jobs::Queues::Standing& standing, v1::Queue& out);
  void add_kept_jobs(const std::string& executor, v1::Queue& out);

  ServiceParts parts_;
  std::function<void()> drain_daemon_;
  std::atomic<bool> draining_ = false;
};

}  // namespace cellcrush::rpc
