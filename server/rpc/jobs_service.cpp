#include "rpc/jobs_service.h"

#include <memory>
#include <optional>
#include <utility>

#include "error_table.h"
#include "rpc/change_log.h"
#include "rpc/create_request.h"
#include "rpc/find_job.h"
#include "rpc/job_query.h"
#include "rpc/page.h"
#include "rpc/request_limits.h"
#include "store/job_state.h"
#include "store/resource_name.h"
#include "translate/case_checker.h"
#include "translate/check_case.h"

namespace cellcrush::rpc {

store::StoredJob JobsService::find(const std::string& name) { return find_job(parts_.reader, name); }

std::int64_t JobsService::find_own(const grpc::ServerContextBase& context, const std::string& name) {
  const auto stored = find(name);
  parts_.gate.require_own(context, stored.job.owner(), stored.job.name());
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

grpc::ServerUnaryReactor* JobsService::CreateJob(grpc::CallbackServerContext* context,
                                                 const v1::CreateJobRequest* request, v1::Job* response) {
  return parts_.checks.run(*context, *request, [=, this] {
    check_request(request->request_id(), request->labels());
    check_priority(request->priority(), "priority");
    parts_.admission.check_priority(request->priority(), "priority");
    parts_.admission.check_time_limit(request->time_limit_s(), "time_limit_s");
    check_length("executor", request->executor(), kLongestName);
    const std::string executor = parts_.queues.executor_for(request->executor(), "executor");
    check_size("case", request->case_().ByteSizeLong(), kLargestCase);
    translate::CaseChecker checker;
    std::optional<jobs::MeshPlaces::Place> mesh;
    mesh.emplace(parts_.places, checker.elements_to_build(request->case_()),
                 [context] { return context->IsCancelled(); });
    const auto verdict = checker.check(request->case_());
    if (!verdict.problems.empty()) return status_of({verdict.problems.begin(), verdict.problems.end()});
    v1::Job job;
    *job.mutable_case_() = request->case_();
    *job.mutable_labels() = request->labels();
    job.set_priority(request->priority());
    job.set_time_limit_s(request->time_limit_s());
    job.set_executor(executor);
    job.set_owner(parts_.gate.caller_of(*context).name);
    const auto answer_with = [&](v1::Job answer) {
      *answer.mutable_notes() = {verdict.notes.begin(), verdict.notes.end()};
      *response = std::move(answer);
      return grpc::Status::OK;
    };
    if (request->validate_only()) return answer_with(std::move(job));
    const std::string hash = payload_hash(*request, job.owner());
    const std::int64_t memory_bytes = parts_.admission.memory_of_job(
        verdict.most_memory_bytes, [&] { return translate::predicted_memory(request->case_()); });
    mesh.reset();
    const std::string owner = job.owner();
    std::optional<jobs::Admission::Place> place;
    const auto admit = [&] {
      place.reset();
      place.emplace(parts_.admission.admit(owner, 1, memory_bytes));
    };
    const auto created =
        parts_.journal.create_job(std::move(job), request->request_id(), hash, verdict.element_steps, admit);
    if (created.is_new) {
      log_change(store::name_of(created.job), "created", owner, request->request_id());
      parts_.queues.enqueue(
          {{created.job, created.job, request->priority(), verdict.element_steps, 0, 0, owner, executor}});
      place.reset();
    }
    auto stored = find(store::name_of(created.job));
    add_live(stored);
    return answer_with(std::move(stored.job));
  });
}

grpc::ServerUnaryReactor* JobsService::GetJob(grpc::CallbackServerContext* context, const v1::GetJobRequest* request,
                                              v1::Job* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    auto stored = find(request->name());
    add_live(stored);
    *response = std::move(stored.job);
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* JobsService::ListJobs(grpc::CallbackServerContext* context,
                                                const v1::ListJobsRequest* request, v1::ListJobsResponse* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    check_length("filter", request->filter(), kLongestFilter);
    check_length("order_by", request->order_by(), kLongestOrder);
    const auto filter = parse_filter(request->filter());
    const bool newest_first = parse_newest_first(request->order_by());
    const std::string question = request->filter() + "\n" + (newest_first ? "newest" : "oldest");
    const auto page = read_page(request->page_size(), request->page_token(), question);
    auto stored = parts_.reader.list_jobs(filter, newest_first, page.after, page.size + 1, kPageBytes,
                                          [context] { return context->IsCancelled(); });
    std::int64_t last = 0;
    auto room = page.room();
    for (auto& job : stored) {
      if (!room.take(job.job.ByteSizeLong())) {
        response->set_next_page_token(page_token(last, question));
        break;
      }
      add_live(job);
      last = job.number;
      *response->add_jobs() = std::move(job.job);
    }
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* JobsService::CancelJob(grpc::CallbackServerContext* context,
                                                 const v1::CancelJobRequest* request, v1::Job* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    const std::int64_t job = find_own(*context, request->name());
    parts_.queues.cancel(job);
    log_change(store::name_of(job), "cancelled", parts_.gate.caller_of(*context).name);
    auto stored = find(request->name());
    add_live(stored);
    *response = std::move(stored.job);
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* JobsService::SuspendJob(grpc::CallbackServerContext* context,
                                                  const v1::SuspendJobRequest* request, v1::Job* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    const std::int64_t job = find_own(*context, request->name());
    parts_.queues.suspend(job, [context] { return context->IsCancelled(); });
    log_change(store::name_of(job), "suspended", parts_.gate.caller_of(*context).name);
    *response = find(request->name()).job;
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* JobsService::ResumeJob(grpc::CallbackServerContext* context,
                                                 const v1::ResumeJobRequest* request, v1::Job* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    const std::int64_t job = find_own(*context, request->name());
    parts_.queues.resume(job);
    log_change(store::name_of(job), "resumed", parts_.gate.caller_of(*context).name);
    *response = find(request->name()).job;
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* JobsService::DeleteJob(grpc::CallbackServerContext* context,
                                                 const v1::DeleteJobRequest* request, v1::DeleteJobResponse*) {
  return parts_.calls.run(*context, *request, [=, this] {
    const std::int64_t job = find_own(*context, request->name());
    parts_.deletion.delete_job(job);
    log_change(store::name_of(job), "deleted", parts_.gate.caller_of(*context).name);
    return grpc::Status::OK;
  });
}

std::unique_ptr<watch::JobSource> JobsService::watch_job(const v1::WatchJobRequest& request) {
  const std::int64_t job = find(request.name()).number;
  check_epoch(parts_.reader.epoch(), request.epoch());
  return std::make_unique<watch::JobSource>(parts_.reader, parts_.hub, job, request.after_sequence(),
                                            watch::WatchCursor::Wanted{request.frames(), true, request.encoding()});
}

std::unique_ptr<JobsSource> JobsService::watch_jobs(const v1::WatchJobsRequest& request) {
  return std::make_unique<JobsSource>(JobsSource::Parts{parts_.reader, parts_.sweeps, parts_.changes, parts_.hub},
                                      request);
}

std::unique_ptr<FrameSeriesSource> JobsService::stream_frames(const v1::StreamFramesRequest& request) {
  return std::make_unique<FrameSeriesSource>(parts_.folder, parts_.reader, find(request.name()), request);
}

std::unique_ptr<FrameSource> JobsService::get_frame(const v1::GetFrameRequest& request) {
  return std::make_unique<FrameSource>(FrameSource::Parts{parts_.folder, parts_.reader, parts_.hub},
                                       find(request.name()), request);
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

template <class Source, class Request>
grpc::ServerWriteReactor<typename Source::Message>* JobsService::open(
    grpc::CallbackServerContext& context, const Request& request,
    std::unique_ptr<Source> (JobsService::*make)(const Request&)) {
  return open_stream<Source>(
      parts_.streams, context, [&] { return parts_.gate.caller_of(context).name; },
      [&] { return (this->*make)(request); });
}

grpc::ServerWriteReactor<v1::JobEvent>* JobsService::WatchJob(grpc::CallbackServerContext* context,
                                                              const v1::WatchJobRequest* request) {
  return open(*context, *request, &JobsService::watch_job);
}

grpc::ServerWriteReactor<v1::WatchJobsResponse>* JobsService::WatchJobs(grpc::CallbackServerContext* context,
                                                                        const v1::WatchJobsRequest* request) {
  return open(*context, *request, &JobsService::watch_jobs);
}

grpc::ServerWriteReactor<v1::StreamFramesResponse>* JobsService::StreamFrames(grpc::CallbackServerContext* context,
                                                                              const v1::StreamFramesRequest* request) {
  return open(*context, *request, &JobsService::stream_frames);
}

grpc::ServerWriteReactor<v1::GetFrameResponse>* JobsService::GetFrame(grpc::CallbackServerContext* context,
                                                                      const v1::GetFrameRequest* request) {
  return open(*context, *request, &JobsService::get_frame);
}

grpc::ServerWriteReactor<v1::DownloadResultResponse>* JobsService::DownloadResult(
    grpc::CallbackServerContext* context, const v1::DownloadResultRequest* request) {
  return open(*context, *request, &JobsService::download);
}

grpc::ServerWriteReactor<v1::ExportJobResponse>* JobsService::ExportJob(grpc::CallbackServerContext* context,
                                                                        const v1::ExportJobRequest* request) {
  return open(*context, *request, &JobsService::export_job);
}

void JobsService::add_streams(StreamTable& table) {
  const auto add = [&]<class Source, class Request>(const char* method,
                                                    std::unique_ptr<Source> (JobsService::*make)(const Request&)) {
    table.add<Source, Request>(std::string("/cellcrush.v1.Jobs/") + method, parts_.streams,
                               [this, make](const Request& request) { return (this->*make)(request); });
  };
  add("WatchJob", &JobsService::watch_job);
  add("WatchJobs", &JobsService::watch_jobs);
  add("StreamFrames", &JobsService::stream_frames);
  add("GetFrame", &JobsService::get_frame);
  add("DownloadResult", &JobsService::download);
  add("ExportJob", &JobsService::export_job);
}

grpc::ServerUnaryReactor* JobsService::GetHistory(grpc::CallbackServerContext* context,
                                                  const v1::GetHistoryRequest* request,
                                                  v1::GetHistoryResponse* response) {
  return parts_.calls.run(*context, *request, [=, this] {
    const std::int64_t job = find(request->name()).number;
    const std::string question = "history of " + store::name_of(job);
    const auto page = read_full_page(request->page_size(), request->page_token(), question);
    commit_samples();
    auto stored = parts_.reader.samples(job, page.after, page.room());
    for (auto& sample : stored.samples) *response->add_samples() = std::move(sample);
    if (stored.has_more) response->set_next_page_token(page_token(stored.last_sequence, question));
    return grpc::Status::OK;
  });
}

}  // namespace cellcrush::rpc
