#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "access/unix_user.h"
#include "allotment.h"
#include "error.h"
#include "jobs/queue_forecast.h"
#include "revision.h"
#include "rpc/request_fields.h"
#include "rpc/services.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"
#include "translate/case_to_spec.h"

namespace cellcrush::rpc {
namespace {

google::protobuf::Timestamp clock_time(jobs::Hold::Clock::time_point time) {
  const std::chrono::nanoseconds from_now = time - jobs::Hold::Clock::now();
  return google::protobuf::util::TimeUtil::GetCurrentTime() +
         google::protobuf::util::TimeUtil::NanosecondsToDuration(from_now.count());
}

v1::Queue::Hold to_proto(const jobs::Hold& hold, const std::string& executor) {
  v1::Queue::Hold out;
  out.set_cause(name_of(hold.shortage));
  out.set_reason(hold.reason);
  out.set_remedy(remedy_for(hold.shortage));
  *out.mutable_since() = clock_time(hold.since);
  if (hold.next_try) *out.mutable_next_try_time() = clock_time(*hold.next_try);
  out.set_executor(executor);
  return out;
}

void add_entry(const store::QueuedJob& job, const std::string& reason, v1::Queue& out) {
  auto& entry = *out.add_entries();
  entry.set_job(store::name_of(job.job));
  entry.set_reason(reason);
  entry.set_priority(job.priority);
  entry.set_executor(job.executor);
}

// Drops entries beyond the limit and counts them.
void limit(v1::Queue& queue) {
  const int extra = queue.entries_size() - jobs::kMostEntries;
  if (extra <= 0) return;
  queue.mutable_entries()->DeleteSubrange(jobs::kMostEntries, extra);
  queue.set_more_count(queue.more_count() + extra);
}

/// The calls of Admin: state and control of the daemon, and the waiting jobs of all executors. Thread-safe.
class AdminCalls {
 public:
  AdminCalls(const ServiceParts& parts, std::function<void()> drain) : parts_(parts), drain_daemon_(std::move(drain)) {}

  v1::Capabilities get_capabilities(const Call&, const v1::GetCapabilitiesRequest&) {
    v1::Capabilities out;
    out.set_version(kSolverRevision);
    out.set_api_version(kApiVersion);
    out.set_result_version(kResultVersion);
    out.set_solver_version(kSolverVersion);
    out.set_draining(draining_);
    const jobs::Queues& queues = parts_.queues;
    out.set_default_executor(queues.default_name());
    for (const auto& standing : queues.standings()) {
      if (standing.executor == store::kLocalExecutor) out.set_worker_limit(standing.slots);
      if (!standing.is_present) continue;
      auto& executor = *out.add_executors();
      executor.set_name(standing.executor);
      executor.set_job_limit(standing.slots);
      const auto running = parts_.reader.queued_jobs(v1::Job::RUNNING, standing.executor);
      executor.set_running_count(static_cast<std::int32_t>(running.size()));
    }
    *out.mutable_start_time() = start_;
    out.set_free_disk_bytes(parts_.folder.free_bytes());
    out.set_kept_disk_bytes(parts_.admission.limits().free_disk_bytes);
    out.set_waiting_count(static_cast<std::int64_t>(parts_.queues.waiting_count()));
    return out;
  }

  v1::Queue get_queue(const Call&, const v1::GetQueueRequest&) {
    v1::Queue out;
    out.set_cores(usable_cores().text());
    const auto standings = parts_.queues.standings();
    for (const auto& standing : standings) {
      if (standing.is_present) add_queue(standing, out);
    }
    std::stable_sort(
        out.mutable_entries()->begin(), out.mutable_entries()->end(),
        [](const auto& one, const auto& other) { return one.seconds_until_start() < other.seconds_until_start(); });
    for (const auto& standing : standings) {
      if (!standing.is_present) add_kept_jobs(standing.executor, out);
    }
    limit(out);
    return out;
  }

  v1::WhoAmIResponse who_am_i(const Call& call, const v1::WhoAmIRequest&) {
    const access::Caller caller = call.caller();
    v1::WhoAmIResponse out;
    out.set_name(caller.name);
    out.set_scope(access::name_of(caller.scope));
    out.set_server_owner(access::own_user());
    out.set_epoch(store::epoch_for_callers(parts_.reader.epoch(), parts_.folder.journal()).id);
    return out;
  }

  v1::CreateLinkResponse create_link(const Call& call, const v1::CreateLinkRequest& request) {
    const std::string& page = request.page();
    check_length("page", page, kLongestName);
    if (!page.empty() && !store::number_of(page) && !store::sweep_number_of(page)) {
      throw InvalidField("page", "is \"" + page + "\".",
                         "Use \"jobs/{job}\", \"sweeps/{sweep}\" or nothing, for the list of jobs.");
    }
    const auto link = parts_.gate.sessions().make_link(call.caller(), page);
    v1::CreateLinkResponse out;
    out.set_url(link.url);
    *out.mutable_expire_time() =
        google::protobuf::util::TimeUtil::TimeTToTimestamp(access::Sessions::Clock::to_time_t(link.end));
    return out;
  }

  v1::DrainResponse drain(const Call& call, const v1::DrainRequest&) {
    log_change(parts_.audit, "", "drained", call.caller().name);
    draining_ = true;
    drain_daemon_();
    return {};
  }

 private:
  /// Jobs of one executor.
  struct Jobs {
    std::vector<jobs::RunningJob> running;  ///< or with the executor, which has not started them
    std::vector<store::QueuedJob> waiting;
  };

  void add_queue(const jobs::Queues::Standing& standing, v1::Queue& out) {
    const Jobs jobs = jobs_of(standing.executor, out);
    jobs::WorkerFacts workers{standing.slots, parts_.step_cost, {}, parts_.owner_max_running, standing.executor};
    if (!standing.holds.empty()) {
      const auto& first = standing.holds.front();
      workers.held = first.reason + " " + remedy_for(first.shortage);
    }
    const auto forecast =
        jobs::forecast_queue(jobs.running, jobs.waiting, workers, [this](std::int64_t job) { return facts_of(job); });
    out.mutable_entries()->MergeFrom(forecast.entries());
    out.set_more_count(out.more_count() + forecast.more_count());
    for (const auto& hold : standing.holds) *out.add_holds() = to_proto(hold, standing.executor);
  }

  void add_kept_jobs(const std::string& executor, v1::Queue& out) {
    const std::string reason =
        "This daemon does not have " + executor + ". Start cellcrushd with it to run the job, or cancel the job.";
    for (const auto& job : parts_.reader.queued_jobs(v1::Job::PENDING, executor)) add_entry(job, reason, out);
  }

  /// Jobs that the executor has, and entries for those that it has not started.
  Jobs jobs_of(const std::string& executor, v1::Queue& out) {
    Jobs jobs;
    for (const auto state : {v1::Job::RUNNING, v1::Job::CANCELLING}) {
      for (const auto& job : parts_.reader.queued_jobs(state, executor))
        jobs.running.push_back(running_job(job, state));
    }
    for (auto& job : parts_.reader.queued_jobs(v1::Job::PENDING, executor)) {
      const auto channel = parts_.hub.find(job.job);
      const std::string place = channel ? channel->newest().place : "";
      if (place.empty()) {
        jobs.waiting.push_back(std::move(job));
      } else {
        add_entry(job, fmt::format("{} has it: {}.", executor, place), out);
        jobs.running.push_back(running_job(job, v1::Job::PENDING));
      }
    }
    return jobs;
  }

  jobs::RunningJob running_job(const store::QueuedJob& job, v1::Job::State state) {
    const int cores = parts_.queues.cores_of(job);
    // A service that was told to stop ends at once.
    if (state == v1::Job::CANCELLING) return {job, 0.0, cores};
    const auto channel = parts_.hub.find(job.job);
    const auto progress = channel ? channel->newest().progress : nullptr;
    const double seconds_left = progress && progress->steps_per_second() > 0.0
                                    ? progress->seconds_left()
                                    : jobs::predicted_seconds(job, facts_of(job.job), cores, parts_.step_cost);
    return {job, seconds_left, cores};
  }

  jobs::JobFacts facts_of(std::int64_t job) {
    jobs::JobFacts out;
    const auto stored = parts_.reader.find_job(job);
    if (!stored) return out;
    out.threads = std::max(stored->job.case_().numerics().threads(), 1);
    const auto& output = stored->job.case_().output();
    const int samples = output.has_sample_count() ? output.sample_count() : OutputSpec().sample_count;
    out.done = static_cast<double>(stored->samples) / samples;
    return out;
  }

  const ServiceParts& parts_;
  std::function<void()> drain_daemon_;
  const google::protobuf::Timestamp start_ = google::protobuf::util::TimeUtil::GetCurrentTime();
  std::atomic<bool> draining_ = false;
};

}  // namespace

void add_admin_methods(MethodTable& table, const ServiceParts& parts, std::function<void()> drain) {
  using access::Scope;
  const auto calls = std::make_shared<AdminCalls>(parts, std::move(drain));
  table.unary("/cellcrush.v1.Admin/GetCapabilities", Scope::read, &parts.calls, calls, &AdminCalls::get_capabilities);
  table.unary("/cellcrush.v1.Admin/GetQueue", Scope::read, &parts.calls, calls, &AdminCalls::get_queue);
  table.unary("/cellcrush.v1.Admin/WhoAmI", Scope::read, &parts.calls, calls, &AdminCalls::who_am_i);
  table.unary("/cellcrush.v1.Admin/CreateLink", Scope::read, &parts.calls, calls, &AdminCalls::create_link);
  table.unary("/cellcrush.v1.Admin/Drain", Scope::admin, &parts.calls, calls, &AdminCalls::drain);
}

}  // namespace cellcrush::rpc
