// What the log says about calls: those that changed something, and those that were refused.
#include <gmock/gmock.h>

#include "access/unix_user.h"
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
  [[nodiscard]] int told(const std::string& words) const { return log_.count_lines(words); }

  LogCapture log_{make_text_formatter()};
};

TEST_F(CallLogTest, EachCallThatChangesSomethingIsOneLine) {
  DaemonOptions options = with_tokens(tcp_options());
  options.workers = 1;
  start(options);
  auto anna = client_of("anna");
  auto bob = client_of("bob");
  auto chief = client_of("chief");
  auto request = job_of(endless_case());
  request.set_validate_only(true);
  anna.create(request);
  EXPECT_EQ(told("created"), 0) << "Nothing was.";
  request.set_validate_only(false);
  request.set_request_id("night\n3");
  for (int i = 0; i < 2; ++i) anna.create(request);
  EXPECT_EQ(told("[info] jobs/1 created by anna, request \"night\\x0a3\""), 1) << log_.text();
  EXPECT_EQ(told("created by"), 1) << "The second call made nothing.";

  auto many = sweep_of(small_case(), kSpeed, {});
  for (int i = 0; i < 1000; ++i) many.mutable_sweep()->mutable_axes(0)->mutable_list()->add_values(50.0 + 0.1 * i);
  many.set_request_id("all");
  create(bob, many);
  EXPECT_EQ(told("[info] sweeps/1 created with 1000 jobs by bob, request \"all\""), 1) << log_.text();
  EXPECT_EQ(told("created"), 2);

  for (const auto& change : {&Client::suspend, &Client::resume, &Client::suspend, &Client::cancel, &Client::remove})
    EXPECT_TRUE((anna.*change)("jobs/1").ok());
  EXPECT_EQ(told("jobs/1 suspended by anna"), 2);
  for (const char* words : {"jobs/1 resumed by anna", "jobs/1 cancelled by anna", "jobs/1 deleted by anna"})
    EXPECT_EQ(told(words), 1) << words;

  cancel_sweep(chief, "sweeps/1");
  retry(bob, "sweeps/1");
  answer_of(*v1::Admin::NewStub(chief.channel), &v1::Admin::Stub::Drain, {});
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
  auto bob = client_of("bob");
  EXPECT_FALSE(try_call(*v1::Admin::NewStub(bob.channel), &v1::Admin::Stub::Drain, {}).ok());
  EXPECT_EQ(
      told("refused a call with PERMISSION_DENIED: /cellcrush.v1.Admin/Drain: Drain requires scope admin; bob has"), 1)
      << log_.text();
  EXPECT_EQ(told("drained by"), 0);
  daemon_.reset();
  start(with_tokens(tcp_options()));
  const std::string job = client().create(small_case());
  EXPECT_FALSE(client_of("bob").cancel(job).ok());
  const std::string owned = job + " belongs to " + access::own_user();
  EXPECT_EQ(told("refused a call with PERMISSION_DENIED: " + owned + "; bob has scope submit"), 1) << log_.text();
  EXPECT_EQ(told("cancelled by"), 0);
}

}  // namespace
}  // namespace cellcrush::testing
