#include "rpc/sweeps_service.h"

#include <absl/cleanup/cleanup.h>
#include <malloc.h>

#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "error_table.h"
#include "jobs/convergence.h"
#include "jobs/sweep_plan.h"
#include "jobs/sweep_points.h"
#include "rpc/request_fields.h"
#include "store/resource_name.h"
#include "translate/case_checker.h"
#include "translate/check_case.h"

namespace cellcrush::rpc {
namespace {

// The caller's fields only; the daemon sets the rest.
v1::CreateSweepRequest without_output(v1::CreateSweepRequest request) {
  auto& sweep = *request.mutable_sweep();
  sweep.clear_name();
  sweep.clear_create_time();
  sweep.clear_jobs();
  sweep.clear_state_counts();
  sweep.clear_owner();
  sweep.clear_notes();
  sweep.clear_predicted_seconds();
  sweep.clear_words();
  return request;
}

void check_numbers(const v1::Sweep& sweep) {
  check_priority(sweep.priority(), "sweep.priority");
  if (sweep.max_parallel() < 0) throw InvalidField("sweep.max_parallel", "is negative.", "Use 0 for no limit.");
  if (sweep.max_failures() < 0) throw InvalidField("sweep.max_failures", "is negative.", "Use 0 for no limit.");
}

std::vector<store::QueuedJob> queued_jobs(const store::Journal::CreatedSweep& created, const jobs::SweepPlan& plan,
                                          const v1::Sweep& sweep, const std::string& executor) {
  std::vector<store::QueuedJob> out;
  for (std::size_t i = 0; i < created.jobs.size(); ++i) {
    out.push_back({created.jobs[i], created.jobs.front(), sweep.priority(), plan.jobs[i].element_steps, created.sweep,
                   sweep.max_parallel(), sweep.owner(), executor});
  }
  return out;
}

double predicted_seconds_of(const jobs::SweepPlan& plan, double step_cost) {
  double element_steps = 0.0;
  for (const auto& job : plan.jobs) element_steps += static_cast<double>(job.element_steps);
  return step_cost * element_steps;
}

}  // namespace

SweepsService::Found SweepsService::find(const std::string& name) {
  check_length("name", name, kLongestName);
  const auto number = store::sweep_number_of(name);
  auto sweep = number ? parts_.sweeps.find_sweep(*number) : std::nullopt;
  if (!sweep) {
    throw ServiceError(ServiceError::Kind::not_found,
                       "There is no sweep \"" + name + "\". Sweep names look like sweeps/12; ListSweeps lists them.");
  }
  return {*number, *std::move(sweep)};
}

std::int64_t SweepsService::find_own(const Call& call, const std::string& name) {
  const auto found = find(name);
  parts_.gate.require_own(call.caller(), found.sweep.owner(), found.sweep.name());
  return found.number;
}

grpc::Status SweepsService::create_sweep(const Call& call, const v1::CreateSweepRequest& given, v1::Sweep& response) {
  auto request = without_output(given);
  check_size("sweep", request.sweep().ByteSizeLong(), kLargestCase);
  check_request(request.request_id(), request.sweep().labels(), "sweep.");
  check_numbers(request.sweep());
  parts_.admission.check_priority(request.sweep().priority(), "sweep.priority");
  parts_.admission.check_time_limit(request.sweep().time_limit_s(), "sweep.time_limit_s");
  check_length("sweep.executor", request.sweep().executor(), kLongestName);
  const std::string executor = parts_.queues.executor_for(request.sweep().executor(), "sweep.executor");
  const std::string owner = call.caller().name;
  const std::string hash = payload_hash(request, owner);
  request.mutable_sweep()->set_owner(owner);
  const auto given_up = [&call] { return call.is_cancelled(); };
  // The cases of 100,000 jobs have 400 MB, most of which the C library would keep.
  const absl::Cleanup return_heap = [] { malloc_trim(0); };
  auto plan = jobs::plan_sweep(request.sweep(), {parts_.places, parts_.check_threads, given_up});
  if (!plan.problems.empty()) return status_of(plan.problems, "sweep");
  const auto answer_with = [&](v1::Sweep answer) {
    *answer.mutable_notes() = plan.notes;
    answer.set_predicted_seconds(predicted_seconds_of(plan, parts_.step_cost));
    response = std::move(answer);
    return grpc::Status::OK;
  };
  if (request.validate_only()) return answer_with(request.sweep());
  for (auto& made : plan.jobs) made.job.set_executor(executor);
  const std::int64_t memory_bytes = parts_.admission.memory_of_job(plan.most_memory_bytes, [&] {
    const v1::Case& largest = plan.jobs[plan.largest].job.case_();
    const jobs::MeshPlaces::Place mesh(parts_.places, translate::CaseChecker().elements_to_build(largest), given_up);
    return translate::predicted_memory(largest);
  });
  std::optional<jobs::Admission::Place> place;
  const auto admit = [&] {
    place.reset();
    place.emplace(parts_.admission.admit(owner, plan.jobs.size(), memory_bytes));
  };
  const auto created = parts_.journal.create_sweep(request.sweep(), plan.jobs, request.request_id(), hash, admit);
  const std::string name = store::sweep_name_of(created.sweep);
  if (created.is_new) {
    log_change(name, "created with " + std::to_string(plan.jobs.size()) + " jobs", owner, request.request_id());
    parts_.queues.enqueue(queued_jobs(created, plan, request.sweep(), executor));
    place.reset();
  }
  return answer_with(find(name).sweep);
}

grpc::Status SweepsService::get_sweep(const Call&, const v1::GetSweepRequest& request, v1::Sweep& response) {
  response = find(request.name()).sweep;
  return grpc::Status::OK;
}

grpc::Status SweepsService::list_sweeps(const Call& call, const v1::ListSweepsRequest& request,
                                        v1::ListSweepsResponse& response) {
  const auto page = read_page(request.page_size(), request.page_token(), "sweeps");
  const std::int64_t before = page.after == 0 ? std::numeric_limits<std::int64_t>::max() : page.after;
  auto room = page.room();
  std::int64_t last = 0;
  const auto numbers = parts_.sweeps.list_sweeps(before, page.size + 1);
  bool has_more = static_cast<int>(numbers.size()) > page.size;
  for (const std::int64_t number : numbers) {
    if (call.is_cancelled()) return grpc::Status::CANCELLED;
    auto sweep = parts_.sweeps.find_sweep(number);
    if (sweep && !room.take(sweep->ByteSizeLong())) {
      has_more = true;
      break;
    }
    last = number;
    // Otherwise it was deleted meanwhile.
    if (sweep) *response.add_sweeps() = *std::move(sweep);
  }
  if (has_more) response.set_next_page_token(page_token(last, "sweeps"));
  return grpc::Status::OK;
}

grpc::Status SweepsService::cancel_sweep(const Call& call, const v1::CancelSweepRequest& request, v1::Sweep& response) {
  const std::int64_t sweep = find_own(call, request.name());
  const auto jobs = parts_.sweeps.jobs_of(sweep);
  parts_.queues.cancel_all(jobs);
  log_change(store::sweep_name_of(sweep), "cancelled", call.caller().name);
  response = find(request.name()).sweep;
  return grpc::Status::OK;
}

grpc::Status SweepsService::delete_sweep(const Call& call, const v1::DeleteSweepRequest& request,
                                         v1::DeleteSweepResponse&) {
  const std::int64_t sweep = find_own(call, request.name());
  parts_.deletion.delete_sweep(sweep, [&call] { return call.is_cancelled(); });
  log_change(store::sweep_name_of(sweep), "deleted", call.caller().name);
  return grpc::Status::OK;
}

grpc::Status SweepsService::retry_failed_jobs(const Call& call, const v1::RetryFailedJobsRequest& request,
                                              v1::Sweep& response) {
  const std::int64_t sweep = find_own(call, request.name());
  // The resources for these cases were admitted with the sweep. The new jobs belong to the sweep's owner.
  const std::string owner = find(request.name()).sweep.owner();
  const auto jobs = parts_.sweeps.jobs_of(sweep);
  if (!jobs.empty()) parts_.queues.require(parts_.reader.executor_of(jobs.front()).value_or(store::kLocalExecutor));
  std::optional<jobs::Admission::Place> place;
  const auto admit = [&](std::size_t count) {
    place.reset();
    place.emplace(parts_.admission.admit(owner, count, 0));
  };
  const auto retried = parts_.journal.retry_failed(sweep, admit);
  log_change(store::sweep_name_of(sweep), "retried with " + std::to_string(retried.size()) + " jobs",
             call.caller().name);
  parts_.queues.enqueue(retried);
  place.reset();
  response = find(request.name()).sweep;
  return grpc::Status::OK;
}

std::unique_ptr<watch::SweepSource> SweepsService::watch_sweep(const v1::WatchSweepRequest& request) {
  check_length("resume_token", request.resume_token(), kLongestResumeToken);
  return std::make_unique<watch::SweepSource>(parts_.reader, parts_.sweeps, parts_.hub, find(request.name()).number,
                                              request.resume_token());
}

void SweepsService::add_methods(MethodTable& table) {
  using access::Scope;
  const auto unary = [&](const char* path, Scope scope, CallPool& pool, auto handle) {
    table.unary(path, scope, &pool, *this, handle);
  };
  unary("/cellcrush.v1.Sweeps/CreateSweep", Scope::submit, parts_.checks, &SweepsService::create_sweep);
  unary("/cellcrush.v1.Sweeps/GetSweep", Scope::read, parts_.calls, &SweepsService::get_sweep);
  unary("/cellcrush.v1.Sweeps/ListSweeps", Scope::read, parts_.calls, &SweepsService::list_sweeps);
  unary("/cellcrush.v1.Sweeps/CancelSweep", Scope::submit, parts_.calls, &SweepsService::cancel_sweep);
  unary("/cellcrush.v1.Sweeps/DeleteSweep", Scope::submit, parts_.calls, &SweepsService::delete_sweep);
  unary("/cellcrush.v1.Sweeps/RetryFailedJobs", Scope::submit, parts_.calls, &SweepsService::retry_failed_jobs);
  unary("/cellcrush.v1.Sweeps/GetSweepTable", Scope::read, parts_.calls, &SweepsService::get_sweep_table);
  unary("/cellcrush.v1.Sweeps/GetConvergence", Scope::read, parts_.calls, &SweepsService::get_convergence);
  table.stream("/cellcrush.v1.Sweeps/WatchSweep", Scope::read, parts_.streams, *this, &SweepsService::watch_sweep);
}

grpc::Status SweepsService::get_sweep_table(const Call&, const v1::GetSweepTableRequest& request,
                                            v1::SweepTable& response) {
  const auto found = find(request.name());
  const std::string question = "table of " + found.sweep.name();
  const auto page = read_full_page(request.page_size(), request.page_token(), question);
  if (page.after == 0) {
    for (auto& field : jobs::swept_fields(found.sweep)) response.add_fields(std::move(field));
  }
  auto stored = parts_.sweeps.rows(found.number, page.after, page.room());
  for (auto& row : stored.rows) *response.add_rows() = std::move(row);
  if (stored.has_more) response.set_next_page_token(page_token(stored.last_point, question));
  return grpc::Status::OK;
}

grpc::Status SweepsService::get_convergence(const Call&, const v1::GetConvergenceRequest& request,
                                            v1::Convergence& response) {
  const double wanted = request.wanted_error_relative();
  if (!(wanted >= 0.0 && wanted <= 1.0)) {
    throw InvalidField("wanted_error_relative", "is " + std::to_string(wanted) + ", not between 0 and 1.",
                       "Use a fraction such as 0.05, or 0 for the default.");
  }
  const auto found = find(request.name());
  response = jobs::convergence_of(found.sweep, parts_.sweeps.rows(found.number).rows,
                                  wanted > 0.0 ? wanted : jobs::kWantedError);
  return grpc::Status::OK;
}

}  // namespace cellcrush::rpc
