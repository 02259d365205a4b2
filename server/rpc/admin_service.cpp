#include "rpc/admin_service.h"

#include "revision.h"
#include "rpc/change_log.h"

namespace cellcrush::rpc {

grpc::Status AdminService::get_capabilities(const Call&, const v1::GetCapabilitiesRequest&,
                                            v1::Capabilities& response) {
  response.set_version(kSolverRevision);
  response.set_draining(draining_);
  const jobs::Queues& queues = parts_.listing.queues;
  response.set_default_executor(queues.default_name());
  for (const auto& standing : queues.standings()) {
    if (standing.executor == store::kLocalExecutor) response.set_worker_limit(standing.slots);
    if (!standing.is_present) continue;
    auto& executor = *response.add_executors();
    executor.set_name(standing.executor);
    executor.set_job_limit(standing.slots);
  }
  return grpc::Status::OK;
}

grpc::Status AdminService::get_queue(const Call&, const v1::GetQueueRequest&, v1::Queue& response) {
  response = listing_.list();
  return grpc::Status::OK;
}

grpc::Status AdminService::drain(const Call& call, const v1::DrainRequest&, v1::DrainResponse&) {
  log_change("", "drained", call.caller().name);
  draining_ = true;
  parts_.drain();
  return grpc::Status::OK;
}

void AdminService::add_methods(MethodTable& table) {
  using access::Scope;
  table.unary("/cellcrush.v1.Admin/GetCapabilities", Scope::read, &parts_.calls, *this,
              &AdminService::get_capabilities);
  table.unary("/cellcrush.v1.Admin/GetQueue", Scope::read, &parts_.calls, *this, &AdminService::get_queue);
  table.unary("/cellcrush.v1.Admin/Drain", Scope::admin, &parts_.calls, *this, &AdminService::drain);
}

}  // namespace cellcrush::rpc
