#include "rpc/admin_service.h"

#include "revision.h"
#include "rpc/change_log.h"

namespace cellcrush::rpc {

grpc::ServerUnaryReactor* AdminService::GetCapabilities(grpc::CallbackServerContext* context,
                                                        const v1::GetCapabilitiesRequest* request,
                                                        v1::Capabilities* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    response->set_version(kSolverRevision);
    response->set_draining(draining_);
    const jobs::Queues& queues = parts_.listing.queues;
    response->set_default_executor(queues.default_name());
    for (const auto& standing : queues.standings()) {
      if (standing.executor == store::kLocalExecutor) response->set_worker_limit(standing.slots);
      if (!standing.is_present) continue;
      auto& executor = *response->add_executors();
      executor.set_name(standing.executor);
      executor.set_job_limit(standing.slots);
    }
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* AdminService::GetQueue(grpc::CallbackServerContext* context,
                                                 const v1::GetQueueRequest* request, v1::Queue* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    *response = listing_.list();
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* AdminService::Drain(grpc::CallbackServerContext* context, const v1::DrainRequest* request,
                                              v1::DrainResponse*) {
  return parts_.calls.run(*context, *request, [=, this] {
    log_change("", "drained", parts_.gate.caller_of(*context).name);
    draining_ = true;
    parts_.drain();
    return grpc::Status::OK;
  });
}

}  // namespace cellcrush::rpc
