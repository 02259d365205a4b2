#include "server/daemon_fixture.h"

#include <stdexcept>

#include "grpc/health/v1/health.grpc.pb.h"
#include "server/daemon_process.h"

namespace cellcrush::testing {

std::unique_ptr<grpc::ClientContext> bounded_context(std::chrono::seconds bound) {
  auto context = std::make_unique<grpc::ClientContext>();
  context->set_deadline(std::chrono::system_clock::now() + bound);
  return context;
}

Client::Client(const std::string& address, const grpc::ChannelArguments& arguments)
    : Client(grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments)) {}

Client::Client(std::shared_ptr<grpc::Channel> through)
    : channel(std::move(through)),
      cases(v1::Cases::NewStub(channel)),
      jobs(v1::Jobs::NewStub(channel)),
      sweeps(v1::Sweeps::NewStub(channel)) {}

v1::CreateJobRequest job_of(const v1::Case& submitted) {
  v1::CreateJobRequest out;
  *out.mutable_case_() = submitted;
  return out;
}

bool is_serving(const Client& client, const std::string& service) {
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(service);
  grpc::health::v1::HealthCheckResponse response;
  const auto status =
      grpc::health::v1::Health::NewStub(client.channel)->Check(bounded_context().get(), request, &response);
  return status.ok() && response.status() == grpc::health::v1::HealthCheckResponse::SERVING;
}

std::string Client::create(const v1::Case& submitted) { return create(job_of(submitted)).name(); }

std::string Client::create(const v1::Case& submitted, v1::Job::State state) {
  std::string job = create(submitted);
  EXPECT_TRUE(wait_for_state(job, state)) << get(job).cause_message();
  return job;
}

v1::Job Client::create(const v1::CreateJobRequest& request) {
  return answer_of(*jobs, &v1::Jobs::Stub::CreateJob, request);
}

grpc::Status Client::try_to(const v1::CreateJobRequest& request) const {
  return try_call(*jobs, &v1::Jobs::Stub::CreateJob, request);
}

grpc::Status Client::try_to(const v1::CreateSweepRequest& request) const {
  return try_call(*sweeps, &v1::Sweeps::Stub::CreateSweep, request);
}

grpc::Status Client::try_to(const v1::ListJobsRequest& request) const {
  return try_call(*jobs, &v1::Jobs::Stub::ListJobs, request);
}

v1::Case Client::preset(const std::string& name) {
  return answer_of(*cases, &v1::Cases::Stub::GetPreset, named<v1::GetPresetRequest>(name)).case_();
}

v1::Job Client::get(const std::string& job) {
  return answer_of(*jobs, &v1::Jobs::Stub::GetJob, named<v1::GetJobRequest>(job));
}

v1::Queue Client::queue() const { return answer_of(*v1::Admin::NewStub(channel), &v1::Admin::Stub::GetQueue, {}); }

std::vector<v1::Job> Client::list(const v1::ListJobsRequest& request) const {
  const auto out = answer_of(*jobs, &v1::Jobs::Stub::ListJobs, request);
  return {out.jobs().begin(), out.jobs().end()};
}

grpc::Status Client::cancel(const std::string& job) {
  return try_call(*jobs, &v1::Jobs::Stub::CancelJob, named<v1::CancelJobRequest>(job));
}

grpc::Status Client::suspend(const std::string& job) {
  return try_call(*jobs, &v1::Jobs::Stub::SuspendJob, named<v1::SuspendJobRequest>(job));
}

grpc::Status Client::resume(const std::string& job) {
  return try_call(*jobs, &v1::Jobs::Stub::ResumeJob, named<v1::ResumeJobRequest>(job));
}

grpc::Status Client::remove(const std::string& job) {
  return try_call(*jobs, &v1::Jobs::Stub::DeleteJob, named<v1::DeleteJobRequest>(job));
}

grpc::Status Client::annotate(const std::string& name, const std::string& note, const std::string& previous) const {
  const auto request_for = [&]<class Request, class Resource>(Resource* (Request::*resource)()) {
    Request out;
    (out.*resource)()->set_name(name);
    (out.*resource)()->set_note(note);
    out.mutable_update_mask()->add_paths("note");
    out.set_previous_note(previous);
    return out;
  };
  return name.starts_with("sweeps/")
             ? try_call(*sweeps, &v1::Sweeps::Stub::UpdateSweep, request_for(&v1::UpdateSweepRequest::mutable_sweep))
             : try_call(*jobs, &v1::Jobs::Stub::UpdateJob, request_for(&v1::UpdateJobRequest::mutable_job));
}

std::vector<v1::Sample> Client::history(const std::string& job) {
  grpc::Status status;
  auto out = history(job, status);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return out;
}

std::vector<v1::Sample> Client::history(const std::string& job, grpc::Status& status) {
  auto request = named<v1::GetHistoryRequest>(job);
  std::vector<v1::Sample> out;
  do {
    v1::GetHistoryResponse page;
    status = jobs->GetHistory(bounded_context().get(), request, &page);
    out.insert(out.end(), page.samples().begin(), page.samples().end());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return out;
}

Client::Watched Client::watch(const std::string& job, std::int64_t after_sequence, bool frames,
                              const OnEvent& on_event) {
  auto request = named<v1::WatchJobRequest>(job);
  request.set_after_sequence(after_sequence);
  request.set_frames(frames);
  const auto context = bounded_context(std::chrono::minutes(4));
  const auto reader = jobs->WatchJob(context.get(), request);
  Watched out;
  v1::JobEvent event;
  while (reader->Read(&event)) {
    if (on_event) on_event(event);
    out.events.push_back(event);
  }
  out.status = reader->Finish();
  return out;
}

bool Client::wait_for_state(const std::string& job, v1::Job::State state) {
  return wait_until([&] { return get(job).state() == state; }, std::chrono::seconds(30));
}

pid_t Client::worker_of(const std::string& job) {
  wait_for_state(job, v1::Job::RUNNING);
  const auto now = get(job);
  if (now.worker_pid() <= 0) throw std::runtime_error(job + " has no worker: " + v1::Job::State_Name(now.state()));
  return static_cast<pid_t>(now.worker_pid());
}

std::string Client::download(const std::string& job, std::int64_t offset, grpc::Status& status) {
  auto request = named<v1::DownloadResultRequest>(job);
  request.set_offset(offset);
  const auto context = bounded_context();
  const auto reader = jobs->DownloadResult(context.get(), request);
  std::string out;
  v1::DownloadResultResponse response;
  while (reader->Read(&response)) {
    EXPECT_EQ(response.offset(), offset + static_cast<std::int64_t>(out.size()));
    out += response.data();
  }
  status = reader->Finish();
  return out;
}

void DaemonFixture::start(const DaemonOptions& options) {
  daemon_.reset();
  daemon_ = std::make_unique<Daemon>(options);
}

DaemonOptions DaemonFixture::default_options() const {
  DaemonOptions options;
  options.data_folder = data_folder();
  options.listen = {"unix:" + (folder_.path() / "socket").string()};
  options.http = "none";
  options.workers = 2;
  options.worker_program = CELLCRUSHD_PROGRAM;
  return options;
}

std::string DaemonFixture::finished_job(const v1::Case& submitted) {
  return client().create(submitted, v1::Job::SUCCEEDED);
}

DaemonOptions DaemonFixture::with_workers(int workers) const {
  auto options = default_options();
  options.workers = workers;
  return options;
}

}  // namespace cellcrush::testing
