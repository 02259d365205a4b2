#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "access/unix_user.h"
#include "server/daemon_process.h"
#include "server/gate_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using Codes = std::vector<grpc::StatusCode>;

constexpr auto kDenied = grpc::StatusCode::PERMISSION_DENIED;

class OwnerTest : public GateFixture {
 protected:
  static v1::CreateJobRequest once() {
    auto out = job_of(small_case());
    out.set_request_id("once");
    return out;
  }

  static v1::CreateJobRequest urgent(int priority) {
    auto out = job_of(endless_case());
    out.set_priority(priority);
    return out;
  }

  static v1::CreateSweepRequest sweep_of_someone_else() {
    auto out = sweep_of(small_case(), kSpeed, {100.0});
    out.mutable_sweep()->set_owner("someone-else");
    out.set_request_id("once");
    return out;
  }

  static Codes change(Client& client, const std::string& job) {
    return {client.annotate(job, "mine").error_code(), client.cancel(job).error_code(),
            client.suspend(job).error_code(), client.resume(job).error_code(), client.remove(job).error_code()};
  }

  static Codes change_sweep(Client& client, const std::string& name) {
    using Stub = v1::Sweeps::Stub;
    return {client.annotate(name, "mine").error_code(),
            try_call(*client.sweeps, &Stub::CancelSweep, named<v1::CancelSweepRequest>(name)).error_code(),
            try_call(*client.sweeps, &Stub::RetryFailedJobs, named<v1::RetryFailedJobsRequest>(name)).error_code(),
            try_call(*client.sweeps, &Stub::DeleteSweep, named<v1::DeleteSweepRequest>(name)).error_code()};
  }

  static std::size_t count(Client& client, const std::string& filter) {
    v1::ListJobsRequest request;
    request.set_filter(filter);
    return client.list(request).size();
  }
};

TEST_F(OwnerTest, AnOwnerIsKeptAndAloneChangesWhatIsHis) {
  start(with_tokens(tcp_options()));
  std::string job;
  std::string sweep;
  {
    auto anna = client_of("anna");
    job = anna.create(once()).name();
    const auto made = create(anna, sweep_of_someone_else());
    EXPECT_EQ(made.owner(), "anna") << "What the request says is not believed.";
    sweep = made.name();
    ASSERT_TRUE(client().watch(job).status.ok());
    EXPECT_EQ(anna.create(once()).name(), job);
  }
  start(with_tokens(tcp_options()));
  EXPECT_EQ(client().get(job).owner(), "anna");
  auto bob = client_of("bob");
  EXPECT_EQ(change(bob, job), Codes(5, kDenied));
  EXPECT_EQ(change_sweep(bob, sweep), Codes(4, kDenied));
  EXPECT_NE(bob.create(once()).name(), job) << "A request_id is its owner's own.";
  EXPECT_EQ(count(bob, "owner = anna"), 2U);
  EXPECT_EQ(count(bob, "owner = anna AND title : other"), 0U);
  EXPECT_EQ(count(bob, "owner = \"bob\""), 1U);
  EXPECT_NE(create(bob, sweep_of_someone_else()).name(), sweep) << "Nor is that of a sweep shared.";
  auto anna = client_of("anna");
  EXPECT_EQ(change(anna, job).back(), grpc::StatusCode::OK);
  EXPECT_NE(change_sweep(anna, sweep).back(), kDenied) << "Its job may still be CANCELLING.";
  const std::string of_local = client().create(small_case(), v1::Job::SUCCEEDED);
  EXPECT_EQ(client().get(of_local).owner(), access::own_user());
  EXPECT_EQ(change(anna, of_local).back(), kDenied);
  auto chief = client_of("chief");
  EXPECT_EQ(change(chief, of_local).back(), grpc::StatusCode::OK);
}

TEST_F(OwnerTest, AnOwnerBeyondAQuotaIsRefusedAndOthersAreNot) {
  auto options = with_tokens(tcp_options());
  options.workers = 3;
  options.limits.owner.running_jobs = 1;
  options.limits.owner.queued_jobs = 2;
  options.limits.owner.priority = 10;
  start(options);
  auto anna = client_of("anna");
  auto bob = client_of("bob");
  const std::string running = anna.create(endless_case(), v1::Job::RUNNING);
  const std::string waiting = anna.create(endless_case());
  anna.create(endless_case());
  const auto refused = anna.try_to(job_of(endless_case()));
  EXPECT_THAT(refused, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "anna has 2 waiting jobs"));
  EXPECT_THAT(refused.error_message(), HasSubstr("--owner-max-queued"));
  EXPECT_EQ(anna.try_to(sweep_of_someone_else()).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(bob.try_to(urgent(11)), Fails(grpc::StatusCode::INVALID_ARGUMENT, "priority is 11"));
  EXPECT_TRUE(client().wait_for_state(bob.create(urgent(10)).name(), v1::Job::RUNNING));
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
  client_of("anna").create(endless_case(), v1::Job::RUNNING);
  std::atomic<int> taken = 0;
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < 16; ++i) {
      callers.emplace_back([&] {
        const auto anna = client_of("anna");
        for (int call = 0; call < 4; ++call) taken += anna.try_to(job_of(endless_case())).ok();
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
  auto anna = client_of("anna");
  anna.create(small_case(), v1::Job::SUCCEEDED);
  // What it left is counted soon after its end.
  grpc::Status status;
  wait_until([&] { return !(status = anna.try_to(job_of(tiny_case()))).ok(); });
  EXPECT_THAT(status, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "--owner-max-disk"));
  client_of("bob").create(tiny_case());
}

}  // namespace
}  // namespace cellcrush::testing
