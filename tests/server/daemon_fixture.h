#pragma once

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <sys/types.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"
#include "daemon.h"
#include "programs/temporary_folder.h"
#include "server/small_case.h"

namespace cellcrush::testing {

/// A context with a deadline.
std::unique_ptr<grpc::ClientContext> bounded_context(std::chrono::seconds bound = std::chrono::seconds(60));

/// How a call ends, and what it answers. A method is named as &v1::Jobs::Stub::GetJob.
template <class Stub, class Request, class Response>
grpc::Status try_call(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                      const std::type_identity_t<Request>& request, Response* out = nullptr) {
  Response unused;
  return (stub.*method)(bounded_context().get(), request, out == nullptr ? &unused : out);
}

/// The answer of a call; fails the test when it is refused.
template <class Stub, class Request, class Response>
Response answer_of(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                   const std::type_identity_t<Request>& request) {
  Response out;
  const auto status = try_call(stub, method, request, &out);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return out;
}

/// A request that only names something.
template <class Request>
Request named(const std::string& name) {
  Request out;
  out.set_name(name);
  return out;
}

/// A client of one daemon. Every call has a deadline of 60 s, a watch one of 4 minutes.
class Client {
 public:
  explicit Client(const std::string& address, const grpc::ChannelArguments& arguments = {});
  explicit Client(std::shared_ptr<grpc::Channel> through);

  /// What a watch gave, and how it ended.
  struct Watched {
    std::vector<v1::JobEvent> events;
    grpc::Status status;
  };
  using OnEvent = std::function<void(const v1::JobEvent&)>;

  /// Makes a job; fails the test when it is refused. Returns its name.
  std::string create(const v1::Case& submitted);
  v1::Job create(const v1::CreateJobRequest& request);
  /// Makes a job and waits until it is in the state; fails the test when it never is.
  std::string create(const v1::Case& submitted, v1::Job::State state);
  /// How a call ends that may be refused.
  grpc::Status try_to(const v1::CreateJobRequest& request) const;
  grpc::Status try_to(const v1::CreateSweepRequest& request) const;
  grpc::Status try_to(const v1::ListJobsRequest& request) const;
  v1::Case preset(const std::string& name);
  v1::Job get(const std::string& job);
  v1::Queue queue() const;
  /// The first page of jobs.
  std::vector<v1::Job> list(const v1::ListJobsRequest& request = {}) const;
  grpc::Status cancel(const std::string& job);
  grpc::Status suspend(const std::string& job);
  grpc::Status resume(const std::string& job);
  grpc::Status remove(const std::string& job);
  /// Writes the note of a job or a sweep in place of the previous one.
  grpc::Status annotate(const std::string& name, const std::string& note, const std::string& previous = "") const;
  /// All pages of it; fails the test when one is refused.
  std::vector<v1::Sample> history(const std::string& job);
  /// All pages up to one that is refused, and how the last call ended.
  std::vector<v1::Sample> history(const std::string& job, grpc::Status& status);
  /// Watches to the end; `on_event` sees each event as it comes.
  Watched watch(const std::string& job, std::int64_t after_sequence = 0, bool frames = false,
                const OnEvent& on_event = {});
  /// Waits until the job is in the state, at most 30 s; false when it never is.
  bool wait_for_state(const std::string& job, v1::Job::State state);
  /// The worker of a job, for which it waits until it runs; throws when it has none (a signal to process 0 would be for
  /// all of the test's own).
  pid_t worker_of(const std::string& job);
  /// The whole result.h5, from an offset on.
  std::string download(const std::string& job, std::int64_t offset, grpc::Status& status);

  const std::shared_ptr<grpc::Channel> channel;
  const std::unique_ptr<v1::Cases::Stub> cases;
  const std::unique_ptr<v1::Jobs::Stub> jobs;
  const std::unique_ptr<v1::Sweeps::Stub> sweeps;
};

/// A request for a job of the case.
v1::CreateJobRequest job_of(const v1::Case& submitted);

/// A call that was refused with this code, and with these words in its message.
MATCHER_P2(Fails, code, words, "") {
  *result_listener << arg.error_code() << ", " << arg.error_message();
  return arg.error_code() == code && arg.error_message().find(words) != std::string::npos;
}

/// Whether grpc.health.v1 says that the service serves.
bool is_serving(const Client& client, const std::string& service);

/// An embedded daemon on a socket in a folder of its own.
class DaemonFixture : public ::testing::Test {
 protected:
  void SetUp() override { start(); }

  void start() { start(default_options()); }
  void start(const DaemonOptions& options);
  [[nodiscard]] DaemonOptions default_options() const;
  /// The default ones, with so many workers.
  [[nodiscard]] DaemonOptions with_workers(int workers) const;
  [[nodiscard]] std::filesystem::path data_folder() const { return folder_.path() / "data"; }
  [[nodiscard]] Client client() const { return Client(daemon_->addresses().front()); }
  /// A job of the case that has SUCCEEDED.
  std::string finished_job(const v1::Case& submitted = small_case());

  TemporaryFolder folder_;
  std::unique_ptr<Daemon> daemon_;
};

}  // namespace cellcrush::testing
