#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "fake_server.h"
#include "program.h"
#include "terminal/table.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;

Script run_script(v1::Job::State end) {
  Script script;
  script.job = make_job(v1::Job::RUNNING);
  script.events = make_events(20, end);
  return script;
}

TEST(Watch, WithoutATerminalThereIsAtMostOneLineASecond) {
  const FakeServer server(run_script(v1::Job::SUCCEEDED));
  const ProgramResult result = server.run({"watch", "test"});
  const std::string progress = result.output.substr(0, result.output.find("jobs/test SUCCEEDED within"));
  EXPECT_GE(count_of(progress, "\n"), 1) << progress;
  EXPECT_LE(count_of(progress, "\n"), 3) << progress;
  EXPECT_EQ(count_of(result.output, "SUCCEEDED"), 1) << result.output;
  EXPECT_EQ(result.output.find('\x1b'), std::string::npos);
}

TEST(Watch, AFailedJobGivesItsCauseAndRemedy) {
  const FakeServer server(run_script(v1::Job::FAILED));
  const ProgramResult result = server.run({"watch", "jobs/test"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("jobs/test FAILED (SOLVER_DIVERGED)"));
  EXPECT_THAT(result.output, HasSubstr("particle 12 left the scene"));
  EXPECT_THAT(result.output, HasSubstr("Remedy: lower numerics.time_step_s"));
}

TEST(Wait, PrintsALineAtTheEndAndReturnsHowItEnded) {
  const FakeServer good(run_script(v1::Job::SUCCEEDED));
  const ProgramResult result = good.run({"wait", "jobs/test"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, "jobs/test SUCCEEDED\n");
  EXPECT_EQ(result.errors, "");
  const FakeServer bad(run_script(v1::Job::FAILED));
  EXPECT_EQ(bad.run({"wait", "test"}).exit_code, 1);
  EXPECT_EQ(bad.run({"wait", "test"}).output, "jobs/test FAILED\n");
  EXPECT_EQ(bad.run({"wait"}).exit_code, 2);
}

TEST(Watch, ACutStreamIsPickedUpBehindTheLastEvent) {
  Script script = run_script(v1::Job::SUCCEEDED);
  script.cut_streams = 2;
  script.events_before_cut = 7;
  const FakeServer server(script);
  const ProgramResult result = server.run({"watch", "jobs/test", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const auto after = server.asked().after_sequences;
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[0], 0);
  EXPECT_EQ(after[1], 4);
  EXPECT_GT(after[2], after[1]);
  std::istringstream lines(result.output);
  int samples = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.front(), '{');
    EXPECT_EQ(line.back(), '}');
    if (line.find("\"sample\":{") != std::string::npos) ++samples;
  }
  EXPECT_EQ(samples, 20);
  EXPECT_THAT(result.output, HasSubstr("\"stress_impact_mpa\""));
}

TEST(Watch, AStreamThatStaysCutEndsWithFour) {
  Script script = run_script(v1::Job::SUCCEEDED);
  script.cut_streams = 1000;
  script.events_before_cut = 0;
  const FakeServer server(script);
  const ProgramResult result = server.run({"watch", "jobs/test"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_GE(server.asked().after_sequences.size(), 3U);
  EXPECT_LT(result.seconds, 15.0);
  EXPECT_THAT(result.errors, HasSubstr("lost the watch of jobs/test"));
}

TEST(Watch, AnUnknownJobEndsWithFive) {
  const FakeServer server(run_script(v1::Job::SUCCEEDED));
  const ProgramResult result = server.run({"watch", "jobs/none"});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.errors, HasSubstr("there is no jobs/none"));
}

TEST(Watch, CtrlCLeavesTheJobRunningAndSaysSo) {
  Script script = run_script(v1::Job::SUCCEEDED);
  script.events.resize(5);
  script.hold = true;
  const FakeServer server(script);
  Program program({"watch", "jobs/test", "--server", server.address()});
  ASSERT_TRUE(program.wait_for_output("strain"));
  program.interrupt();
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.errors, HasSubstr("jobs/test continues"));
  EXPECT_LT(result.seconds, 10.0);
}

TEST(Watch, APendingJobSaysThatItWaits) {
  Script script;
  script.job = make_job(v1::Job::PENDING);
  script.hold = true;
  const FakeServer server(script);
  Program program({"watch", "jobs/test", "--server", server.address()});
  EXPECT_TRUE(program.wait_for_output("PENDING: waiting for a worker"));
  program.interrupt();
  EXPECT_EQ(program.wait().exit_code, 130);
}

TEST(Watch, OnATerminalTheDisplayIsRedrawnInPlaceWithinItsWidth) {
  const FakeServer server(run_script(v1::Job::SUCCEEDED));
  for (const int columns : {40, 80, 132}) {
    const ProgramResult result = Program({"watch", "jobs/test", "--server", server.address()}, columns).wait();
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("\x1b[J"));
    EXPECT_THAT(result.output, HasSubstr("█"));
    const std::string display = result.output.substr(0, result.output.find("jobs/test SUCCEEDED within"));
    expect_no_wider(display, columns - 1);
  }
}

}  // namespace
}  // namespace cellcrush::client::testing
