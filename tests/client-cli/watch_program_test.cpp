#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "fake_server.h"
#include "program.h"
#include "terminal/table.h"

namespace cellcrush::client::testing {
namespace {

Script run_script(v1::Job::State end) {
  Script script;
  script.job = make_job(v1::Job::RUNNING);
  script.events = make_events(20, end);
  return script;
}

int count_lines(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

TEST(Watch, ASucceededJobEndsWithItsPlateauBesideTheory) {
  const FakeServer server(run_script(v1::Job::SUCCEEDED));
  const ProgramResult result = run_program({"watch", "jobs/test", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  for (const char* part :
       {"jobs/test SUCCEEDED within 48 s: 20 504 steps", "3.41 MPa", "0.447 MPa", "3.37 MPa  shock theory (Eq. 51)",
        "0.301 MPa  quasi-static", "20-40 %", "0.760", "1.23 %", "12.1 %"}) {
    EXPECT_NE(result.output.find(part), std::string::npos) << part << "\n" << result.output;
  }
}

TEST(Watch, WithoutATerminalThereIsAtMostOneLineASecond) {
  const FakeServer server(run_script(v1::Job::SUCCEEDED));
  const ProgramResult result = run_program({"watch", "test", "--server", server.address()});
  const std::string progress = result.output.substr(0, result.output.find("jobs/test SUCCEEDED within"));
  EXPECT_GE(count_lines(progress), 2) << progress;
  EXPECT_LE(count_lines(progress), 4) << progress;
  EXPECT_EQ(result.output.find('\x1b'), std::string::npos);
}

TEST(Watch, AFailedJobGivesItsCauseAndRemedy) {
  const FakeServer server(run_script(v1::Job::FAILED));
  const ProgramResult result = run_program({"watch", "jobs/test", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.output.find("jobs/test FAILED (SOLVER_DIVERGED)"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("particle 12 left the scene"), std::string::npos);
  EXPECT_NE(result.output.find("Remedy: lower numerics.time_step_s"), std::string::npos);
}

TEST(Watch, ACutStreamIsPickedUpBehindTheLastEvent) {
  Script script = run_script(v1::Job::SUCCEEDED);
  script.cut_streams = 2;
  script.events_before_cut = 7;
  const FakeServer server(script);
  const ProgramResult result = run_program({"watch", "jobs/test", "--json", "--server", server.address()});
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
  EXPECT_NE(result.output.find("\"stress_impact_mpa\""), std::string::npos);
}

TEST(Watch, AStreamThatStaysCutEndsWithFour) {
  Script script = run_script(v1::Job::SUCCEEDED);
  script.cut_streams = 1000;
  script.events_before_cut = 0;
  const FakeServer server(script);
  const ProgramResult result = run_program({"watch", "jobs/test", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_GE(server.asked().after_sequences.size(), 3U);
  EXPECT_LT(result.seconds, 15.0);
  EXPECT_NE(result.errors.find("lost the watch of jobs/test"), std::string::npos) << result.errors;
}

TEST(Watch, AnUnknownJobEndsWithFive) {
  const FakeServer server(run_script(v1::Job::SUCCEEDED));
  const ProgramResult result = run_program({"watch", "jobs/none", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_NE(result.errors.find("there is no jobs/none"), std::string::npos) << result.errors;
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
  EXPECT_NE(result.errors.find("jobs/test continues"), std::string::npos) << result.errors;
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
    EXPECT_NE(result.output.find("\x1b[J"), std::string::npos);
    EXPECT_NE(result.output.find("█"), std::string::npos);
    const std::string display = result.output.substr(0, result.output.find("jobs/test SUCCEEDED within"));
    std::istringstream lines(display);
    for (std::string line; std::getline(lines, line);) {
      // Escape sequences take no room: ESC [ ... letter.
      std::string shown;
      for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\x1b') {
          while (i < line.size() && std::isalpha(static_cast<unsigned char>(line[i])) == 0) ++i;
        } else if (line[i] != '\r') {
          shown += line[i];
        }
      }
      EXPECT_LT(display_width(shown), columns) << shown;
    }
  }
}

}  // namespace
}  // namespace cellcrush::client::testing
