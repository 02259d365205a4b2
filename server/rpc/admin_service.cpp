#include "rpc/admin_service.h"

#include "rpc/change_log.h"
#include "rpc/error_table.h"
#include "version.h"

namespace cellcrush::rpc {

grpc::Status AdminService::GetCapabilities(grpc::ServerContext*, const v1::GetCapabilitiesRequest*,
                                           v1::Capabilities* response) {
  return answer([&] {
    response->set_version(kSolverRevision);
    response->set_worker_limit(parts_.workers.count);
    return grpc::Status::OK;
  });
}

std::vector<jobs::RunningJob> AdminService::running_jobs(v1::JobState state) {
  std::vector<jobs::RunningJob> out;
  for (const auto& job : parts_.reader.queued_jobs(state)) {
    double seconds_left = parts_.workers.step_cost * static_cast<double>(job.element_steps);
    const auto channel = parts_.hub.find(job.job);
    const auto progress = channel ? channel->newest().progress : nullptr;
    if (progress && progress->steps_per_second() > 0.0) seconds_left = progress->seconds_left();
    // One that is told to stop ends at once.
    out.push_back({job, state == v1::RUNNING ? seconds_left : 0.0});
  }
  return out;
}

grpc::Status AdminService::GetQueue(grpc::ServerContext*, const v1::GetQueueRequest*, v1::Queue* response) {
  return answer([&] {
    auto running = running_jobs(v1::RUNNING);
    const auto stopping = running_jobs(v1::CANCELLING);
    running.insert(running.end(), stopping.begin(), stopping.end());
    jobs::WorkerFacts workers = parts_.workers;
    workers.held = parts_.scheduler.is_held();
    *response = jobs::forecast_queue(running, parts_.reader.queued_jobs(v1::PENDING), workers);
    return grpc::Status::OK;
  });
}

grpc::Status AdminService::Drain(grpc::ServerContext* context, const v1::DrainRequest*, v1::DrainResponse*) {
  return answer([&] {
    log_change("", "drained", parts_.gate.caller_of(*context).name);
    parts_.drain();
    return grpc::Status::OK;
  });
}

}  // namespace cellcrush::rpc
