#include "rpc/jobs_service.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "jobs/job_state.h"
#include "rpc/create_request.h"
#include "rpc/error_table.h"
#include "translate/check_case.h"

namespace cellcrush::rpc {
namespace {

constexpr int kDefaultPage = 50;
constexpr int kLargestPage = 1000;
constexpr std::size_t kPageBytes = 3'000'000;  // a page ends early rather than pass a client's limit of 4 MiB

// A page token is the number of the last job of the page before.
std::optional<std::int64_t> parse_token(const std::string& token) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), number);
  if (error != std::errc() || end != token.data() + token.size() || number < 1) return std::nullopt;
  return number;
}

// A watch that is refused before it begins.
class RefusedWatch final : public grpc::ServerWriteReactor<v1::JobEvent> {
 public:
  explicit RefusedWatch(const grpc::Status& status) { Finish(status); }
  void OnDone() override { delete this; }
};

}  // namespace

store::StoredJob JobsService::find(const std::string& name) {
  const auto number = jobs::number_of(name);
  auto stored = number ? parts_.reader.find_job(*number) : std::nullopt;
  if (!stored) {
    throw ServiceError(ServiceError::Kind::not_found,
                       "There is no job \"" + name + "\". Names are like jobs/12; ListJobs gives them.");
  }
  return *std::move(stored);
}

void JobsService::add_progress(store::StoredJob& stored) {
  if (stored.job.state() != v1::RUNNING) return;
  const auto channel = parts_.hub.find(stored.number);
  if (!channel) return;
  if (const auto progress = channel->newest().progress) *stored.job.mutable_progress() = *progress;
}

grpc::Status JobsService::CreateJob(grpc::ServerContext*, const v1::CreateJobRequest* request, v1::Job* response) {
  return answer([&] {
    if (const auto fault = check_request(*request))
      return invalid_argument(fault->field, fault->message, fault->remedy);
    const auto check = translate::check_case(request->case_());
    if (check.response.problems_size() > 0) return status_of(check.response.problems());
    v1::Job job;
    *job.mutable_case_() = request->case_();
    *job.mutable_labels() = request->labels();
    if (request->validate_only()) {
      *response = std::move(job);
      return grpc::Status::OK;
    }
    const auto created = parts_.journal.create_job(std::move(job), request->request_id(), payload_hash(*request));
    if (created.is_new) parts_.scheduler.enqueue(created.job);
    auto stored = find(jobs::name_of(created.job));
    add_progress(stored);
    *response = std::move(stored.job);
    return grpc::Status::OK;
  });
}

grpc::Status JobsService::GetJob(grpc::ServerContext*, const v1::GetJobRequest* request, v1::Job* response) {
  return answer([&] {
    auto stored = find(request->name());
    add_progress(stored);
    *response = std::move(stored.job);
    return grpc::Status::OK;
  });
}

grpc::Status JobsService::ListJobs(grpc::ServerContext*, const v1::ListJobsRequest* request,
                                   v1::ListJobsResponse* response) {
  return answer([&] {
    if (!request->filter().empty()) return unimplemented("The field filter of ListJobs");
    if (!request->order_by().empty()) return unimplemented("The field order_by of ListJobs");
    if (request->page_size() < 0) return invalid_argument("page_size", "is negative.", "Use 1 to 1000, or 0 for 50.");
    const int size = request->page_size() == 0 ? kDefaultPage : std::min(request->page_size(), kLargestPage);
    std::int64_t before = std::numeric_limits<std::int64_t>::max();
    if (!request->page_token().empty()) {
      const auto token = parse_token(request->page_token());
      if (!token)
        return invalid_argument("page_token", "is none of this daemon's.",
                                "Use the next_page_token of the page before.");
      before = *token;
    }
    auto stored = parts_.reader.list_jobs(before, size + 1);
    std::size_t bytes = 0;
    for (auto& job : stored) {
      bytes += job.job.ByteSizeLong();
      const bool full = response->jobs_size() == size || (bytes > kPageBytes && response->jobs_size() > 0);
      if (full) {
        response->set_next_page_token(std::to_string(job.number + 1));
        break;
      }
      add_progress(job);
      *response->add_jobs() = std::move(job.job);
    }
    return grpc::Status::OK;
  });
}

grpc::Status JobsService::CancelJob(grpc::ServerContext*, const v1::CancelJobRequest*, v1::Job*) {
  return unimplemented("CancelJob");
}

grpc::Status JobsService::SuspendJob(grpc::ServerContext*, const v1::SuspendJobRequest*, v1::Job*) {
  return unimplemented("SuspendJob");
}

grpc::Status JobsService::ResumeJob(grpc::ServerContext*, const v1::ResumeJobRequest*, v1::Job*) {
  return unimplemented("ResumeJob");
}

grpc::Status JobsService::DeleteJob(grpc::ServerContext*, const v1::DeleteJobRequest*, v1::DeleteJobResponse*) {
  return unimplemented("DeleteJob");
}

grpc::ServerWriteReactor<v1::JobEvent>* JobsService::WatchJob(grpc::CallbackServerContext*,
                                                              const v1::WatchJobRequest* request) {
  try {
    const auto stored = find(request->name());
    return WatchReactor::start({parts_.reader, parts_.hub, parts_.pump, parts_.bookmark_interval}, stored.number,
                               *request);
  } catch (const std::exception& error) {
    return new RefusedWatch(status_of(error));
  }
}

grpc::Status JobsService::GetHistory(grpc::ServerContext*, const v1::GetHistoryRequest* request,
                                     v1::GetHistoryResponse* response) {
  return answer([&] {
    for (auto& sample : parts_.reader.samples(find(request->name()).number))
      *response->add_samples() = std::move(sample);
    return grpc::Status::OK;
  });
}

}  // namespace cellcrush::rpc
