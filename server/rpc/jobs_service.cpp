#include "rpc/jobs_service.h"

#include <memory>
#include <optional>
#include <utility>

#include "error_table.h"
#include "rpc/job_query.h"
#include "rpc/request_fields.h"
#include "store/job_state.h"
#include "store/resource_name.h"
#include "translate/case_checker.h"
#include "translate/check_case.h"

namespace cellcrush::rpc {

store::StoredJob JobsService::find(const std::string& name) { return find_job(parts_.reader, name); }

std::int64_t JobsService::find_own(const Call& call, const std::string& name) {
  const auto stored = find(name);
  parts_.gate.require_own(call.caller(), stored.job.owner(), stored.job.name());
  return stored.number;
}

void JobsService::add_live(store::StoredJob& stored) {
  const v1::Job::State state = stored.job.state();
  const auto channel = parts_.hub.find(stored.number);
  if (!channel || store::is_terminal(state)) return;
  const auto newest = channel->newest();
  stored.job.set_place(newest.place);
  const bool has_worker = state == v1::Job::RUNNING || state == v1::Job::CANCELLING;
  if (has_worker && newest.progress) *stored.job.mutable_progress() = *newest.progress;
}

// Samples of an unwatched job may still be gathered in memory. If they cannot be made durable, only those before them
// are returned.
void JobsService::commit_samples() {
  try {
    parts_.journal.commit_samples();
  } catch (const ServiceError&) {
    // The journal retries on its own and logs the failure.
  }
}

grpc::Status JobsService::create_job(const Call& call, const v1::CreateJobRequest& request, v1::Job& response) {
  check_request(request.request_id(), request.labels());
  check_priority(request.priority(), "priority");
  parts_.admission.check_priority(request.priority(), "priority");
  parts_.admission.check_time_limit(request.time_limit_s(), "time_limit_s");
  check_length("executor", request.executor(), kLongestName);
  const std::string executor = parts_.queues.executor_for(request.executor(), "executor");
  check_size("case", request.case_().ByteSizeLong(), kLargestCase);
  translate::CaseChecker checker;
  std::optional<jobs::MeshPlaces::Place> mesh;
  mesh.emplace(parts_.places, checker.elements_to_build(request.case_()), [&call] { return call.is_cancelled(); });
  const auto verdict = checker.check(request.case_());
  if (!verdict.problems.empty()) return status_of({verdict.problems.begin(), verdict.problems.end()});
  v1::Job job;
  *job.mutable_case_() = request.case_();
  *job.mutable_labels() = request.labels();
  job.set_priority(request.priority());
  job.set_time_limit_s(request.time_limit_s());
  job.set_executor(executor);
  job.set_owner(call.caller().name);
  const auto answer_with = [&](v1::Job answer) {
    *answer.mutable_notes() = {verdict.notes.begin(), verdict.notes.end()};
    response = std::move(answer);
    return grpc::Status::OK;
  };
  if (request.validate_only()) return answer_with(std::move(job));
  const std::string hash = payload_hash(request, job.owner());
  const std::int64_t memory_bytes = parts_.admission.memory_of_job(
      verdict.most_memory_bytes, [&] { return translate::predicted_memory(request.case_()); });
  mesh.reset();
  const std::string owner = job.owner();
  std::optional<jobs::Admission::Place> place;
  const auto admit = [&] {
    place.reset();
    place.emplace(parts_.admission.admit(owner, 1, memory_bytes));
  };
  const auto created =
      parts_.journal.create_job(std::move(job), request.request_id(), hash, verdict.element_steps, admit);
  if (created.is_new) {
    log_change(store::name_of(created.job), "created", owner, request.request_id());
    parts_.queues.enqueue(
        {{created.job, created.job, request.priority(), verdict.element_steps, 0, 0, owner, executor}});
    place.reset();
  }
  auto stored = find(store::name_of(created.job));
  add_live(stored);
  return answer_with(std::move(stored.job));
}

grpc::Status JobsService::get_job(const Call&, const v1::GetJobRequest& request, v1::Job& response) {
  auto stored = find(request.name());
  add_live(stored);
  response = std::move(stored.job);
  return grpc::Status::OK;
}

grpc::Status JobsService::list_jobs(const Call& call, const v1::ListJobsRequest& request,
                                    v1::ListJobsResponse& response) {
  check_length("filter", request.filter(), kLongestFilter);
  check_length("order_by", request.order_by(), kLongestOrder);
  const auto filter = parse_filter(request.filter());
  const bool newest_first = parse_newest_first(request.order_by());
  const std::string question = request.filter() + "\n" + (newest_first ? "newest" : "oldest");
  const auto page = read_page(request.page_size(), request.page_token(), question);
  auto stored = parts_.reader.list_jobs(filter, newest_first, page.after, page.size + 1, kPageBytes,
                                        [&call] { return call.is_cancelled(); });
  std::int64_t last = 0;
  auto room = page.room();
  for (auto& job : stored) {
    if (!room.take(job.job.ByteSizeLong())) {
      response.set_next_page_token(page_token(last, question));
      break;
    }
    add_live(job);
    last = job.number;
    *response.add_jobs() = std::move(job.job);
  }
  return grpc::Status::OK;
}

grpc::Status JobsService::cancel_job(const Call& call, const v1::CancelJobRequest& request, v1::Job& response) {
  const std::int64_t job = find_own(call, request.name());
  parts_.queues.cancel(job);
  log_change(store::name_of(job), "cancelled", call.caller().name);
  auto stored = find(request.name());
  add_live(stored);
  response = std::move(stored.job);
  return grpc::Status::OK;
}

grpc::Status JobsService::suspend_job(const Call& call, const v1::SuspendJobRequest& request, v1::Job& response) {
  const std::int64_t job = find_own(call, request.name());
  parts_.queues.suspend(job, [&call] { return call.is_cancelled(); });
  log_change(store::name_of(job), "suspended", call.caller().name);
  response = find(request.name()).job;
  return grpc::Status::OK;
}

grpc::Status JobsService::resume_job(const Call& call, const v1::ResumeJobRequest& request, v1::Job& response) {
  const std::int64_t job = find_own(call, request.name());
  parts_.queues.resume(job);
  log_change(store::name_of(job), "resumed", call.caller().name);
  response = find(request.name()).job;
  return grpc::Status::OK;
}

grpc::Status JobsService::delete_job(const Call& call, const v1::DeleteJobRequest& request, v1::DeleteJobResponse&) {
  const std::int64_t job = find_own(call, request.name());
  parts_.deletion.delete_job(job);
  log_change(store::name_of(job), "deleted", call.caller().name);
  return grpc::Status::OK;
}

std::unique_ptr<watch::JobSource> JobsService::watch_job(const v1::WatchJobRequest& request) {
  const std::int64_t job = find(request.name()).number;
  check_epoch(parts_.reader.epoch(), request.epoch());
  return std::make_unique<watch::JobSource>(parts_.reader, parts_.hub, job, request.after_sequence(),
                                            watch::WatchCursor::Wanted{request.frames(), true, request.encoding()});
}

std::unique_ptr<JobsSource> JobsService::watch_jobs(const v1::WatchJobsRequest& request) {
  return std::make_unique<JobsSource>(parts_, request);
}

std::unique_ptr<FrameSeriesSource> JobsService::stream_frames(const v1::StreamFramesRequest& request) {
  return std::make_unique<FrameSeriesSource>(parts_, find(request.name()), request);
}

std::unique_ptr<FrameSource> JobsService::get_frame(const v1::GetFrameRequest& request) {
  return std::make_unique<FrameSource>(parts_, find(request.name()), request);
}

std::unique_ptr<DownloadSource> JobsService::download(const v1::DownloadResultRequest& request) {
  const auto stored = find(request.name());
  if (!stored.job.has_summary()) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       stored.job.name() + " is " + v1::Job::State_Name(stored.job.state()) +
                           " and has no result. A job has a result once it has SUCCEEDED, or was cancelled or failed "
                           "while running.");
  }
  return std::make_unique<DownloadSource>(parts_.folder.job_folder(stored.number).result(), request.offset());
}

std::unique_ptr<ExportSource> JobsService::export_job(const v1::ExportJobRequest& request) {
  return std::make_unique<ExportSource>(ExportSource::Parts{parts_.folder, parts_.reader, parts_.places, exports_},
                                        find(request.name()), request);
}

void JobsService::add_methods(MethodTable& table) {
  using access::Scope;
  const auto unary = [&](const char* path, Scope scope, CallPool& pool, auto handle) {
    table.unary(path, scope, &pool, *this, handle);
  };
  const auto stream = [&](const char* path, auto make) {
    table.stream(path, Scope::read, parts_.streams, *this, make);
  };
  unary("/cellcrush.v1.Jobs/CreateJob", Scope::submit, parts_.checks, &JobsService::create_job);
  unary("/cellcrush.v1.Jobs/GetJob", Scope::read, parts_.calls, &JobsService::get_job);
  unary("/cellcrush.v1.Jobs/ListJobs", Scope::read, parts_.calls, &JobsService::list_jobs);
  unary("/cellcrush.v1.Jobs/CancelJob", Scope::submit, parts_.calls, &JobsService::cancel_job);
  unary("/cellcrush.v1.Jobs/SuspendJob", Scope::submit, parts_.calls, &JobsService::suspend_job);
  unary("/cellcrush.v1.Jobs/ResumeJob", Scope::submit, parts_.calls, &JobsService::resume_job);
  unary("/cellcrush.v1.Jobs/DeleteJob", Scope::submit, parts_.calls, &JobsService::delete_job);
  unary("/cellcrush.v1.Jobs/GetHistory", Scope::read, parts_.calls, &JobsService::get_history);
  stream("/cellcrush.v1.Jobs/WatchJob", &JobsService::watch_job);
  stream("/cellcrush.v1.Jobs/WatchJobs", &JobsService::watch_jobs);
  stream("/cellcrush.v1.Jobs/StreamFrames", &JobsService::stream_frames);
  stream("/cellcrush.v1.Jobs/GetFrame", &JobsService::get_frame);
  stream("/cellcrush.v1.Jobs/DownloadResult", &JobsService::download);
  stream("/cellcrush.v1.Jobs/ExportJob", &JobsService::export_job);
}

grpc::Status JobsService::get_history(const Call&, const v1::GetHistoryRequest& request,
                                      v1::GetHistoryResponse& response) {
  const std::int64_t job = find(request.name()).number;
  const std::string question = "history of " + store::name_of(job);
  const auto page = read_full_page(request.page_size(), request.page_token(), question);
  commit_samples();
  auto stored = parts_.reader.samples(job, page.after, page.room());
  for (auto& sample : stored.samples) *response.add_samples() = std::move(sample);
  if (stored.has_more) response.set_next_page_token(page_token(stored.last_sequence, question));
  return grpc::Status::OK;
}

}  // namespace cellcrush::rpc
