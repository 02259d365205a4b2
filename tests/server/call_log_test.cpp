// What the log tells of calls: those that changed something, and those that were refused.
#include <gmock/gmock.h>

#include "log_format.h"
#include "server/gate_fixture.h"
#include "server/log_capture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CallLogTest : public GateFixture {
 protected:
  [[nodiscard]] std::unique_ptr<grpc::ClientContext> as(const std::string& name) const {
    return context_of({{}, {}, tokens_.at(name)});
  }

  [[nodiscard]] int told(const std::string& words) const { return log_.count_lines(words); }

  LogCapture log_{make_text_formatter()};
};

TEST_F(CallLogTest, EachCallThatChangesSomethingIsOneLine) {
  DaemonOptions options = with_tokens(tcp_options());
  options.workers = 1;
  start(options);
  const auto jobs = v1::Jobs::NewStub(channel({}));
  auto create = job_of(endless_case());
  create.set_validate_only(true);
  v1::Job job;
  ASSERT_TRUE(jobs->CreateJob(as("anna").get(), create, &job).ok());
  EXPECT_EQ(told("created"), 0) << "Nothing was.";
  create.set_validate_only(false);
  create.set_request_id("night\n3");
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(jobs->CreateJob(as("anna").get(), create, &job).ok());
  EXPECT_EQ(told("[info] jobs/1 created by anna, request \"night\\x0a3\""), 1) << log_.text();
  EXPECT_EQ(told("created by"), 1) << "The second call made nothing.";

  const auto sweeps = v1::Sweeps::NewStub(channel({}));
  auto many = sweep_of(small_case(), kSpeed, {});
  for (int i = 0; i < 1000; ++i) many.mutable_sweep()->mutable_axes(0)->mutable_list()->add_values(50.0 + 0.1 * i);
  many.set_request_id("all");
  v1::Sweep sweep;
  ASSERT_TRUE(sweeps->CreateSweep(as("bob").get(), many, &sweep).ok());
  EXPECT_EQ(told("[info] sweeps/1 created with 1000 jobs by bob, request \"all\""), 1) << log_.text();
  EXPECT_EQ(told("created"), 2);

  const auto change = [&](auto method, auto request, auto response) {
    request.set_name("jobs/1");
    const auto status = ((*jobs).*method)(as("anna").get(), request, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
  };
  change(&v1::Jobs::Stub::SuspendJob, v1::SuspendJobRequest(), v1::Job());
  change(&v1::Jobs::Stub::ResumeJob, v1::ResumeJobRequest(), v1::Job());
  change(&v1::Jobs::Stub::SuspendJob, v1::SuspendJobRequest(), v1::Job());
  change(&v1::Jobs::Stub::CancelJob, v1::CancelJobRequest(), v1::Job());
  change(&v1::Jobs::Stub::DeleteJob, v1::DeleteJobRequest(), v1::DeleteJobResponse());
  EXPECT_EQ(told("jobs/1 suspended by anna"), 2);
  for (const char* words : {"jobs/1 resumed by anna", "jobs/1 cancelled by anna", "jobs/1 deleted by anna"})
    EXPECT_EQ(told(words), 1) << words;

  ASSERT_TRUE(sweeps->CancelSweep(as("chief").get(), named<v1::CancelSweepRequest>("sweeps/1"), &sweep).ok());
  ASSERT_TRUE(sweeps->RetryFailedJobs(as("bob").get(), named<v1::RetryFailedJobsRequest>("sweeps/1"), &sweep).ok());
  v1::DrainResponse drained;
  ASSERT_TRUE(v1::Admin::NewStub(channel({}))->Drain(as("chief").get(), {}, &drained).ok());
  for (const char* words :
       {"sweeps/1 cancelled by chief", "sweeps/1 retried with 0 jobs by bob", "the daemon drained by chief"})
    EXPECT_EQ(told(words), 1) << words;
}

TEST_F(CallLogTest, RefusedCallsAreWarnedOfWithoutTheirTokens) {
  start(with_tokens(tcp_options()));
  const std::string wrong = tokens_.at("anna").substr(1);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(list({{}, {}, wrong}).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  const int lines = told(
      "[warning] refused a call with UNAUTHENTICATED: /cellcrush.v1.Jobs/ListJobs: The server does not recognise the "
      "token of this call");
  EXPECT_GE(lines, 1) << log_.text();
  EXPECT_LE(lines, 3) << log_.text();
  daemon_.reset();
  EXPECT_EQ(told("more refused calls"), 1) << log_.text();
  EXPECT_THAT(log_.text(), Not(HasSubstr(wrong)));
}

TEST_F(CallLogTest, WhoMayNotIsNamed) {
  start(with_tokens(tcp_options()));
  v1::DrainResponse drained;
  EXPECT_FALSE(v1::Admin::NewStub(channel({}))->Drain(as("bob").get(), {}, &drained).ok());
  EXPECT_EQ(
      told("refused a call with PERMISSION_DENIED: /cellcrush.v1.Admin/Drain: Drain requires scope admin; bob has"), 1)
      << log_.text();
  EXPECT_EQ(told("drained by"), 0);
  daemon_.reset();
  start(with_tokens(tcp_options()));
  const std::string job = client().create(small_case());
  v1::Job found;
  EXPECT_FALSE(
      v1::Jobs::NewStub(channel({}))->CancelJob(as("bob").get(), named<v1::CancelJobRequest>(job), &found).ok());
  EXPECT_EQ(told("refused a call with PERMISSION_DENIED: " + job + " belongs to local; bob has scope submit"), 1)
      << log_.text();
  EXPECT_EQ(told("cancelled by"), 0);
}

}  // namespace
}  // namespace cellcrush::testing
