#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "server/daemon_process.h"
#include "server/gate_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

using OwnerTest = GateFixture;

/// Calls of one owner.
class Owner {
 public:
  Owner(const std::shared_ptr<grpc::Channel>& channel, std::string token)
      : jobs_(v1::Jobs::NewStub(channel)), sweeps_(v1::Sweeps::NewStub(channel)), token_(std::move(token)) {}

  v1::Job create(const v1::Case& submitted, const std::string& request_id = "", int priority = 0) {
    auto request = job_of(submitted);
    request.set_priority(priority);
    request.set_request_id(request_id);
    v1::Job out;
    last = jobs_->CreateJob(context().get(), request, &out);
    return out;
  }
  v1::Sweep create_sweep() {
    auto request = sweep_of(small_case(), kSpeed, {100.0});
    request.mutable_sweep()->set_owner("someone-else");
    v1::Sweep out;
    last = sweeps_->CreateSweep(context().get(), request, &out);
    return out;
  }
  /// Codes of cancel, suspend, resume and delete of a job.
  std::vector<grpc::StatusCode> change(const std::string& name) {
    v1::Job job;
    v1::DeleteJobResponse deleted;
    return {jobs_->CancelJob(context().get(), named<v1::CancelJobRequest>(name), &job).error_code(),
            jobs_->SuspendJob(context().get(), named<v1::SuspendJobRequest>(name), &job).error_code(),
            jobs_->ResumeJob(context().get(), named<v1::ResumeJobRequest>(name), &job).error_code(),
            jobs_->DeleteJob(context().get(), named<v1::DeleteJobRequest>(name), &deleted).error_code()};
  }
  /// Codes of cancel, retry and delete of a sweep.
  std::vector<grpc::StatusCode> change_sweep(const std::string& name) {
    v1::Sweep sweep;
    v1::DeleteSweepResponse deleted;
    return {sweeps_->CancelSweep(context().get(), named<v1::CancelSweepRequest>(name), &sweep).error_code(),
            sweeps_->RetryFailedJobs(context().get(), named<v1::RetryFailedJobsRequest>(name), &sweep).error_code(),
            sweeps_->DeleteSweep(context().get(), named<v1::DeleteSweepRequest>(name), &deleted).error_code()};
  }
  int count(const std::string& filter) {
    v1::ListJobsRequest request;
    request.set_filter(filter);
    v1::ListJobsResponse response;
    last = jobs_->ListJobs(context().get(), request, &response);
    return response.jobs_size();
  }

  grpc::Status last;

 private:
  [[nodiscard]] std::unique_ptr<grpc::ClientContext> context() const {
    auto out = bounded_context();
    if (!token_.empty()) out->AddMetadata("authorization", "Bearer " + token_);
    return out;
  }

  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Sweeps::Stub> sweeps_;
  std::string token_;
};

TEST_F(OwnerTest, AnOwnerIsKeptAndAloneChangesWhatIsHis) {
  using Codes = std::vector<grpc::StatusCode>;
  const auto denied = grpc::StatusCode::PERMISSION_DENIED;
  start(with_tokens(tcp_options()));
  std::string job;
  std::string sweep;
  {
    Owner anna(channel({}), tokens_.at("anna"));
    job = anna.create(small_case(), "once").name();
    ASSERT_TRUE(anna.last.ok()) << anna.last.error_message();
    const auto made = anna.create_sweep();
    EXPECT_EQ(made.owner(), "anna") << "What the request says is not believed.";
    sweep = made.name();
    ASSERT_TRUE(client().watch(job).status.ok());
    EXPECT_EQ(anna.create(small_case(), "once").name(), job);
  }
  start(with_tokens(tcp_options()));
  EXPECT_EQ(client().get(job).owner(), "anna");
  Owner bob(channel({}), tokens_.at("bob"));
  EXPECT_EQ(bob.change(job), (Codes{denied, denied, denied, denied}));
  EXPECT_EQ(bob.change_sweep(sweep), (Codes{denied, denied, denied}));
  EXPECT_NE(bob.create(small_case(), "once").name(), job) << "Nobody is given another's job as his own.";
  EXPECT_TRUE(bob.last.ok()) << "A request_id is its owner's own. " << bob.last.error_message();
  EXPECT_EQ(bob.count("owner = anna"), 2);
  EXPECT_EQ(bob.count("owner = \"bob\""), 1);
  Owner anna(channel({}), tokens_.at("anna"));
  EXPECT_EQ(anna.change(job).back(), grpc::StatusCode::OK);
  EXPECT_NE(anna.change_sweep(sweep).back(), denied) << "Its job may still be CANCELLING.";
  Owner local(grpc::CreateChannel(daemon_->addresses().front(), grpc::InsecureChannelCredentials()), "");
  const std::string of_local = local.create(small_case()).name();
  EXPECT_EQ(client().get(of_local).owner(), "local");
  ASSERT_TRUE(client().watch(of_local).status.ok());
  EXPECT_EQ(anna.change(of_local).back(), denied);
  Owner chief(channel({}), tokens_.at("chief"));
  EXPECT_EQ(chief.change(of_local).back(), grpc::StatusCode::OK);
}

TEST_F(OwnerTest, AnOwnerBeyondAQuotaIsRefusedAndOthersAreNot) {
  auto options = with_tokens(tcp_options());
  options.workers = 3;
  options.limits.owner.running_jobs = 1;
  options.limits.owner.queued_jobs = 2;
  options.limits.owner.priority = 10;
  start(options);
  Owner anna(channel({}), tokens_.at("anna"));
  Owner bob(channel({}), tokens_.at("bob"));
  const std::string running = anna.create(endless_case()).name();
  ASSERT_TRUE(client().wait_for_state(running, v1::Job::RUNNING));
  const std::string waiting = anna.create(endless_case()).name();
  anna.create(endless_case());
  ASSERT_TRUE(anna.last.ok()) << anna.last.error_message();
  anna.create(endless_case());
  EXPECT_EQ(anna.last.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(anna.last.error_message(), HasSubstr("anna has 2 waiting jobs"));
  EXPECT_THAT(anna.last.error_message(), HasSubstr("--owner-max-queued"));
  anna.create_sweep();
  EXPECT_EQ(anna.last.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  bob.create(endless_case(), "", 11);
  EXPECT_EQ(bob.last.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(bob.last.error_message(), HasSubstr("priority is 11"));
  const std::string of_bob = bob.create(endless_case(), "", 10).name();
  EXPECT_TRUE(client().wait_for_state(of_bob, v1::Job::RUNNING));
  EXPECT_EQ(client().get(waiting).state(), v1::Job::PENDING) << "A worker is free, but not for anna.";
  const auto queue = client().queue();
  ASSERT_EQ(queue.entries_size(), 2);
  EXPECT_THAT(queue.entries(0).reason(),
              HasSubstr("anna, is already running the 1 job that --owner-max-running allows"));
  ASSERT_TRUE(client().cancel(running).ok());
  EXPECT_TRUE(client().wait_for_state(waiting, v1::Job::RUNNING));
}

TEST_F(OwnerTest, CallsAtTheSameTimeDoNotOvershootAQuota) {
  constexpr int kQuota = 5;
  auto options = with_tokens(tcp_options());
  options.workers = 1;
  options.limits.owner.queued_jobs = kQuota;
  start(options);
  const std::string running = Owner(channel({}), tokens_.at("anna")).create(endless_case()).name();
  ASSERT_TRUE(client().wait_for_state(running, v1::Job::RUNNING));
  std::atomic<int> taken = 0;
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < 16; ++i) {
      callers.emplace_back([&] {
        Owner anna(channel({}), tokens_.at("anna"));
        for (int call = 0; call < 4; ++call) {
          anna.create(endless_case());
          if (anna.last.ok()) ++taken;
        }
      });
    }
  }
  EXPECT_EQ(taken, kQuota);
}

TEST_F(OwnerTest, AnOwnerWhoseJobsFillTheirDiskIsRefusedUntilSomeAreDeleted) {
  auto options = with_tokens(tcp_options());
  options.housekeeping_interval = std::chrono::milliseconds(50);
  options.limits.owner.disk_bytes = 10'000;
  start(options);
  Owner anna(channel({}), tokens_.at("anna"));
  Owner bob(channel({}), tokens_.at("bob"));
  const std::string job = anna.create(small_case()).name();
  ASSERT_TRUE(client().wait_for_state(job, v1::Job::SUCCEEDED));
  // What it left is counted soon after its end.
  wait_until([&] {
    anna.create(tiny_case());
    return !anna.last.ok();
  });
  EXPECT_EQ(anna.last.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(anna.last.error_message(), HasSubstr("--owner-max-disk"));
  bob.create(tiny_case());
  EXPECT_TRUE(bob.last.ok()) << bob.last.error_message();
}

}  // namespace
}  // namespace cellcrush::testing
