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

Script sweep_script(const std::vector<v1::Job::State>& ends) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.preset.set_name("type-i");
  *script.preset.mutable_case_() = make_job(v1::Job::RUNNING).case_();
  script.sweeps = make_sweep_script(ends);
  return script;
}

const std::vector<v1::Job::State> kThreeSucceed = {v1::Job::SUCCEEDED, v1::Job::SUCCEEDED, v1::Job::SUCCEEDED};

TEST(Sweep, OnATerminalItSaysHowManyPointsAreChecked) {
  const FakeServer server(sweep_script(kThreeSucceed));
  Program program({"sweep", "preset:type-i", "--over", "loading.speed_m_per_s=50,100,2e2", "--over",
                   "lattice.imperfection.seed=seeds:20", "--server", server.address()},
                  80);
  EXPECT_EQ(program.wait().output,
            "loading.speed_m_per_s = 50, 100, 200 m/s (3 values)\r\n"
            "lattice.imperfection.seed = 1 to 20 (20 values)\r\n"
            "Checking 60 points...\r\nsweeps/test\r\n");
}

TEST(Sweep, SendsTheCaseWithAGridOfAxesAndLabelsAndPrintsItsName) {
  const FakeServer server(sweep_script(kThreeSucceed));
  const ProgramResult result = server.run({"sweep",          "preset:type-i",
                                           "--set",          "depth_mm=5",
                                           "--over",         "loading.speed_m_per_s=50,100,2e2",
                                           "--over",         "lattice.hexagon.columns=20,40",
                                           "--label",        "who=me",
                                           "--request-id",   "abc",
                                           "--priority",     "-3",
                                           "--max-parallel", "4",
                                           "--max-failures", "2",
                                           "--executor",     "slurm/a"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, "sweeps/test\n");
  const auto creates = server.asked().sweeps.creates;
  ASSERT_EQ(creates.size(), 1U);
  const v1::Sweep& sweep = creates[0].sweep();
  EXPECT_EQ(creates[0].request_id(), "abc");
  EXPECT_EQ(sweep.case_().depth_mm(), 5.0);
  EXPECT_EQ(sweep.labels().at("who"), "me");
  EXPECT_EQ(sweep.priority(), -3);
  EXPECT_EQ(sweep.max_parallel(), 4);
  EXPECT_EQ(sweep.max_failures(), 2);
  EXPECT_EQ(sweep.executor(), "slurm/a");
  ASSERT_EQ(sweep.axes_size(), 2);
  EXPECT_EQ(sweep.axes(0).field(), "loading.speed_m_per_s");
  ASSERT_EQ(sweep.axes(0).list().values_size(), 3);
  EXPECT_EQ(sweep.axes(0).list().values(2), 200.0);
  EXPECT_EQ(sweep.axes(1).list().values(1), 40.0);
}

TEST(Sweep, PrintsNotesOnStderrExceptInJson) {
  Script script = sweep_script(kThreeSucceed);
  *script.sweeps.sweep.add_notes() = from_text<v1::Problem>(R"(
    field: "material.density_kg_per_m3" value: "2.7" remedy: "Give it in kg/m^3."
    message: "is far below that of any solid. This applies to point 2 of 4.")");
  const FakeServer server(std::move(script));
  const std::vector<std::string> sweep = {"sweep", "preset:type-i", "--over", "loading.speed_m_per_s=50,100"};
  const ProgramResult result = server.run(sweep);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, "sweeps/test\n");
  EXPECT_EQ(count_of(result.errors, "Note: material.density_kg_per_m3 = 2.7 is far below"), 1) << result.errors;
  EXPECT_EQ(count_of(result.errors, "point 2 of 4"), 1) << result.errors;
  std::vector<std::string> with_json = sweep;
  with_json.emplace_back("--json");
  const ProgramResult json = server.run(with_json);
  EXPECT_EQ(json.errors, "");
  EXPECT_EQ(count_of(json.output, "2 of 4"), 1) << json.output;
}

TEST(Sweep, BadAxesAreRefused) {
  const FakeServer server(sweep_script(kThreeSucceed));
  for (const char* axis : {"loading.speed_m_per_s", "=1,2", "a=1,,2", "a=1,x", "a="}) {
    const ProgramResult result = server.run({"sweep", "preset:type-i", "--over", axis});
    EXPECT_EQ(result.exit_code, 2) << axis;
    EXPECT_THAT(result.errors, HasSubstr(std::string("--over ") + axis));
  }
  EXPECT_EQ(server.run({"sweep", "preset:type-i", "--over", "a=1", "--over", "a=2"}).exit_code, 2);
  EXPECT_EQ(server.run({"sweep", "preset:type-i", "--over", "a=1", "--label", "x"}).exit_code, 2);
  EXPECT_EQ(server.run({"sweep", "preset:type-i"}).exit_code, 2);
  EXPECT_TRUE(server.asked().sweeps.creates.empty());
}

TEST(SweepWatch, EndsWithTheTableAndZeroWhenAllSucceeded) {
  const FakeServer server(sweep_script(kThreeSucceed));
  const ProgramResult result =
      server.run({"sweep", "preset:type-i", "--over", "loading.speed_m_per_s=50,100,150", "--watch"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output.find("sweeps/test\n"), 0U);
  expect_parts_in(result.output,
                  {"3 of 3 jobs ended", "speed  job", "jobs/test-3", "quadratic through the three points: 0.3"});
  EXPECT_EQ(count_of(result.output, "  0.0 %"), 0) << "the states of ended jobs come first\n" << result.output;
  EXPECT_LE(count_of(result.output, "jobs ended"), 4) << "at most a line a second\n" << result.output;
  EXPECT_EQ(result.output.find('\x1b'), std::string::npos);
}

TEST(SweepWatch, OfAnEndedSweepIsOneLineAndItsTable) {
  Script script = sweep_script(kThreeSucceed);
  std::erase_if(script.sweeps.responses, [](const auto& response) { return !response.event().has_snapshot(); });
  for (auto& response : script.sweeps.responses)
    response.mutable_event()->mutable_snapshot()->mutable_job()->set_state(v1::Job::SUCCEEDED);
  const FakeServer server(script);
  const ProgramResult result = server.run({"watch", "sweeps/test"});
  EXPECT_EQ(result.output.find("sweeps/test  100.0 %  3 of 3 jobs ended\n\nspeed"), 0U) << result.output;
}

TEST(SweepWatch, EndsWithOneWhenAJobFailedOrWasCancelled) {
  for (const v1::Job::State state : {v1::Job::FAILED, v1::Job::CANCELLED}) {
    const FakeServer server(sweep_script({v1::Job::SUCCEEDED, state}));
    const ProgramResult result = server.run({"watch", "sweeps/test"});
    EXPECT_EQ(result.exit_code, 1) << result.output;
    EXPECT_THAT(result.output, HasSubstr("1 " + v1::Job::State_Name(state)));
  }
}

TEST(SweepWatch, ACutStreamIsPickedUpByItsTokenWithoutLoss) {
  Script script = sweep_script(kThreeSucceed);
  script.sweeps.cut_streams = 2;
  script.sweeps.responses_before_cut = 7;
  const FakeServer server(script);
  const ProgramResult result = server.run({"watch", "sweeps/test", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(server.asked().sweeps.tokens, (std::vector<std::string>{"", "7", "14"}));
  EXPECT_EQ(count_of(result.output, "\"sample\":{"), 12);
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.front(), '{');
    EXPECT_EQ(line.back(), '}');
  }
}

TEST(SweepWatch, AStreamThatStaysCutEndsWithFour) {
  Script script = sweep_script(kThreeSucceed);
  script.sweeps.cut_streams = 1000;
  script.sweeps.responses_before_cut = 0;
  const FakeServer server(script);
  const ProgramResult result = server.run({"watch", "sweeps/test"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_GE(server.asked().sweeps.tokens.size(), 3U);
  EXPECT_LT(result.seconds, 15.0);
  EXPECT_THAT(result.errors, HasSubstr("`cellcrush watch sweeps/test` shows it again"));
}

TEST(SweepWatch, AStreamThatEndsBeforeItsJobsIsNotTakenForTheEnd) {
  Script script = sweep_script(kThreeSucceed);
  script.sweeps.responses.resize(script.sweeps.responses.size() - 1);
  const FakeServer server(script);
  EXPECT_EQ(server.run({"watch", "sweeps/test"}).exit_code, 4);
}

TEST(SweepWatch, CtrlCLeavesTheSweepRunningAndSaysSo) {
  Script script = sweep_script({v1::Job::SUCCEEDED});
  script.sweeps.responses.resize(4);
  script.sweeps.hold = true;
  const FakeServer server(script);
  Program program({"watch", "sweeps/test", "--server", server.address()});
  ASSERT_TRUE(program.wait_for_output("0 of 1 job ended"));
  program.interrupt();
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.errors, HasSubstr("sweeps/test continues"));
}

TEST(SweepWatch, OnATerminalThereIsALineAJobRedrawnInPlaceWithinItsWidth) {
  const FakeServer server(sweep_script(kThreeSucceed));
  for (const int columns : {40, 100}) {
    const ProgramResult result = Program({"watch", "sweeps/test", "--server", server.address()}, columns).wait();
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("\x1b[7A"));
    expect_no_wider(result.output, columns);
  }
}

TEST(SweepTable, IsPrintedAsATextCsvOrJson) {
  const FakeServer server(sweep_script({v1::Job::SUCCEEDED, v1::Job::FAILED}));
  const ProgramResult text = server.run({"table", "test"});
  EXPECT_EQ(text.exit_code, 0) << text.errors;
  EXPECT_THAT(text.output, HasSubstr("jobs/test-2 FAILED (SOLVER_DIVERGED)"));
  const ProgramResult csv = server.run({"table", "sweeps/test", "--csv"});
  EXPECT_EQ(csv.output.find("loading.speed_m_per_s,job,state,"), 0U) << csv.output;
  EXPECT_EQ(std::count(csv.output.begin(), csv.output.end(), '\n'), 3);
  const auto table = from_json<v1::SweepTable>(server.run({"table", "test", "--json"}).output);
  EXPECT_EQ(table.rows_size(), 2);
  EXPECT_EQ(server.run({"table", "test", "--json", "--csv"}).exit_code, 2);
  EXPECT_EQ(server.run({"table", "none"}).exit_code, 5);
  EXPECT_EQ(server.run({"table", "jobs/test"}).exit_code, 2);
}

TEST(SweepTable, OfManyPagesIsOneTable) {
  const FakeServer server(
      sweep_script({v1::Job::SUCCEEDED, v1::Job::FAILED, v1::Job::SUCCEEDED, v1::Job::SUCCEEDED, v1::Job::SUCCEEDED}));
  const auto table = from_json<v1::SweepTable>(server.run({"table", "test", "--json"}).output);
  EXPECT_EQ(table.fields_size(), 1);
  ASSERT_EQ(table.rows_size(), 5);
  EXPECT_EQ(table.rows(4).job(), "jobs/test-5");
  EXPECT_TRUE(table.next_page_token().empty());
}

TEST(SweepLife, CancelRetryShowAndListNameTheSweep) {
  const FakeServer server(sweep_script({v1::Job::SUCCEEDED, v1::Job::FAILED}));
  const ProgramResult cancel = server.run({"cancel", "sweeps/test"});
  EXPECT_EQ(cancel.exit_code, 0) << cancel.errors;
  EXPECT_EQ(cancel.output, "sweeps/test: 2 jobs, 1 FAILED, 1 SUCCEEDED\n");
  EXPECT_EQ(server.run({"retry", "test"}).exit_code, 0);
  const ProgramResult show = server.run({"show", "sweeps/test"});
  EXPECT_THAT(show.output, HasSubstr("over loading.speed_m_per_s  50, 100\n"));
  EXPECT_THAT(show.output, HasSubstr("jobs/test-1, jobs/test-2\n"));
  const ProgramResult list = server.run({"list", "--sweeps"});
  EXPECT_EQ(count_of(list.output, "sweeps/test"), 2) << list.output;
  EXPECT_EQ(count_of(server.run({"list", "--sweeps", "--limit", "1"}).output, "sweeps/test"), 1);
  EXPECT_EQ(server.run({"list", "--sweeps", "--filter", "x = 1"}).exit_code, 2);
  const AskedOfSweeps asked = server.asked().sweeps;
  EXPECT_EQ(asked.cancelled, std::vector<std::string>{"sweeps/test"});
  EXPECT_EQ(asked.retried, std::vector<std::string>{"sweeps/test"});
  for (const char* command : {"show", "cancel", "watch"}) {
    EXPECT_EQ(server.run({command, "sweeps/none"}).exit_code, 5) << command;
  }
  EXPECT_EQ(server.run({"suspend", "sweeps/test"}).exit_code, 2);
}

}  // namespace
}  // namespace cellcrush::client::testing
