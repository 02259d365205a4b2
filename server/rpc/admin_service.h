#pragma once

#include <atomic>
#include <functional>

#include "access/gate.h"
#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "jobs/queue_forecast.h"
#include "jobs/queue_hold.h"
#include "jobs/scheduler.h"
#include "rpc/call_pool.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::rpc {

/// State and control of the daemon. Thread-safe.
class AdminService final : public v1::Admin::CallbackService {
 public:
  /// All of it outlives the service.
  struct Parts {
    store::JournalReader& reader;
    watch::Hub& hub;
    jobs::Scheduler& scheduler;
    jobs::QueueHold& hold;
    jobs::WorkerFacts workers;
    const access::Gate& gate;
    CallPool& calls;
    std::function<void()> drain;
  };

  explicit AdminService(const Parts& parts) : parts_(parts) {}

  grpc::ServerUnaryReactor* GetCapabilities(grpc::CallbackServerContext* context,
                                            const v1::GetCapabilitiesRequest* request,
                                            v1::Capabilities* response) override;
  grpc::ServerUnaryReactor* GetQueue(grpc::CallbackServerContext* context, const v1::GetQueueRequest* request,
                                     v1::Queue* response) override;
  grpc::ServerUnaryReactor* Drain(grpc::CallbackServerContext* context, const v1::DrainRequest* request,
                                  v1::DrainResponse* response) override;

 private:
  std::vector<jobs::RunningJob> running_jobs(v1::Job::State state);
  jobs::JobFacts facts_of(std::int64_t job);

  Parts parts_;
  std::atomic<bool> draining_ = false;
};

}  // namespace cellcrush::rpc
