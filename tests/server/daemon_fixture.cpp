#include "server/daemon_fixture.h"

#include <stdexcept>
#include <thread>

namespace cellcrush::testing {

std::unique_ptr<grpc::ClientContext> bounded_context(std::chrono::seconds bound) {
  auto context = std::make_unique<grpc::ClientContext>();
  context->set_deadline(std::chrono::system_clock::now() + bound);
  return context;
}

Client::Client(const std::string& address, const grpc::ChannelArguments& arguments)
    : channel(grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments)),
      cases(v1::Cases::NewStub(channel)),
      jobs(v1::Jobs::NewStub(channel)),
      sweeps(v1::Sweeps::NewStub(channel)) {}

std::string Client::create(const v1::Case& submitted) {
  v1::CreateJobRequest request;
  *request.mutable_case_() = submitted;
  v1::Job job;
  const auto status = jobs->CreateJob(bounded_context().get(), request, &job);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return job.name();
}

v1::Job Client::get(const std::string& job) {
  v1::GetJobRequest request;
  request.set_name(job);
  v1::Job out;
  const auto status = jobs->GetJob(bounded_context().get(), request, &out);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return out;
}

grpc::Status Client::cancel(const std::string& job) {
  v1::CancelJobRequest request;
  request.set_name(job);
  v1::Job out;
  return jobs->CancelJob(bounded_context().get(), request, &out);
}

grpc::Status Client::suspend(const std::string& job) {
  v1::SuspendJobRequest request;
  request.set_name(job);
  v1::Job out;
  return jobs->SuspendJob(bounded_context().get(), request, &out);
}

grpc::Status Client::resume(const std::string& job) {
  v1::ResumeJobRequest request;
  request.set_name(job);
  v1::Job out;
  return jobs->ResumeJob(bounded_context().get(), request, &out);
}

grpc::Status Client::remove(const std::string& job) {
  v1::DeleteJobRequest request;
  request.set_name(job);
  v1::DeleteJobResponse out;
  return jobs->DeleteJob(bounded_context().get(), request, &out);
}

std::vector<v1::Sample> Client::history(const std::string& job) {
  grpc::Status status;
  auto out = history(job, status);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return out;
}

std::vector<v1::Sample> Client::history(const std::string& job, grpc::Status& status) {
  v1::GetHistoryRequest request;
  request.set_name(job);
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
  v1::WatchJobRequest request;
  request.set_name(job);
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
  for (int i = 0; i < 600; ++i) {
    if (get(job).state() == state) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

pid_t Client::worker_of(const std::string& job) {
  wait_for_state(job, v1::Job::RUNNING);
  const auto now = get(job);
  if (now.worker_pid() <= 0) throw std::runtime_error(job + " has no worker: " + v1::Job::State_Name(now.state()));
  return static_cast<pid_t>(now.worker_pid());
}

std::string Client::download(const std::string& job, std::int64_t offset, grpc::Status& status) {
  v1::DownloadResultRequest request;
  request.set_name(job);
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

}  // namespace cellcrush::testing
