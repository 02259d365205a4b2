#include "rpc/admin_service.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "error.h"
#include "error_table.h"
#include "revision.h"
#include "rpc/change_log.h"
#include "store/resource_name.h"

namespace cellcrush::rpc {
namespace {

google::protobuf::Timestamp clock_time(jobs::Hold::Clock::time_point time) {
  const std::chrono::nanoseconds from_now = time - jobs::Hold::Clock::now();
  return google::protobuf::util::TimeUtil::GetCurrentTime() +
         google::protobuf::util::TimeUtil::NanosecondsToDuration(from_now.count());
}

v1::Queue::Hold to_proto(const jobs::Hold& hold) {
  v1::Queue::Hold out;
  out.set_cause(name_of(hold.shortage));
  out.set_reason(hold.reason);
  out.set_remedy(remedy_for(hold.shortage));
  *out.mutable_since() = clock_time(hold.since);
  if (hold.next_try) *out.mutable_next_try_time() = clock_time(*hold.next_try);
  return out;
}

}  // namespace

grpc::ServerUnaryReactor* AdminService::GetCapabilities(grpc::CallbackServerContext* context,
                                                        const v1::GetCapabilitiesRequest* request,
                                                        v1::Capabilities* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    response->set_version(kSolverRevision);
    response->set_worker_limit(parts_.workers.count);
    response->set_draining(draining_);
    return grpc::Status::OK;
  });
}

std::vector<jobs::RunningJob> AdminService::running_jobs(v1::Job::State state) {
  std::vector<jobs::RunningJob> out;
  for (const auto& job : parts_.reader.queued_jobs(state)) {
    const int cores = parts_.scheduler.cores_of(job.job);
    // A service that was told to stop ends at once.
    double seconds_left = 0.0;
    if (state == v1::Job::RUNNING) {
      const auto channel = parts_.hub.find(job.job);
      const auto progress = channel ? channel->newest().progress : nullptr;
      seconds_left = progress && progress->steps_per_second() > 0.0
                         ? progress->seconds_left()
                         : jobs::predicted_seconds(job, facts_of(job.job), cores, parts_.workers.step_cost);
    }
    out.push_back({job, seconds_left, cores});
  }
  return out;
}

jobs::JobFacts AdminService::facts_of(std::int64_t job) {
  jobs::JobFacts out;
  const auto stored = parts_.reader.find_job(job);
  if (!stored) return out;
  out.threads = std::max(stored->job.case_().numerics().threads(), 1);
  // The worker that ran the job has reported the mesh.
  const auto mesh = stored->job.attempt() > 0 ? parts_.reader.mesh(job) : std::nullopt;
  if (!mesh) return out;
  try {
    out.element_steps_done =
        mesh->thickness_mm_size() * std::max<std::int64_t>(parts_.reader.last_sampled_step(job), 0);
  } catch (const ServiceError& error) {
    // A damaged job must not hide the others.
    spdlog::error("Cannot read the progress of {}: {}", store::name_of(job), error.what());
  }
  return out;
}

grpc::ServerUnaryReactor* AdminService::GetQueue(grpc::CallbackServerContext* context,
                                                 const v1::GetQueueRequest* request, v1::Queue* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    auto running = running_jobs(v1::Job::RUNNING);
    const auto stopping = running_jobs(v1::Job::CANCELLING);
    running.insert(running.end(), stopping.begin(), stopping.end());
    jobs::WorkerFacts workers = parts_.workers;
    const auto holds = parts_.hold.holds();
    if (!holds.empty()) workers.held = holds.front().reason + " " + remedy_for(holds.front().shortage);
    *response = jobs::forecast_queue(running, parts_.reader.queued_jobs(v1::Job::PENDING), workers,
                                     [this](std::int64_t job) { return facts_of(job); });
    for (const auto& hold : holds) *response->add_holds() = to_proto(hold);
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
