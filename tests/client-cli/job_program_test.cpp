#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <fstream>

#include "case_file/case_source.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using google::protobuf::util::MessageDifferencer;

Script preset_script() {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.preset = from_text<v1::Preset>(R"(
    name: "type-i" title: "Type I of the tests" assumptions: "The depth is that of the specimen.")");
  *script.preset.mutable_case_() = make_job(v1::Job::RUNNING).case_();
  return script;
}

TEST(Presets, AreListedAndShownAsACaseFileThatReadsBack) {
  const FakeServer server(preset_script());
  const ProgramResult list = server.run({"presets"});
  EXPECT_EQ(list.exit_code, 0) << list.errors;
  EXPECT_EQ(list.output, "preset:type-i  Type I of the tests\n");
  const ProgramResult show = server.run({"show", "preset:type-i"});
  EXPECT_THAT(show.output, HasSubstr("# Type I of the tests"));
  EXPECT_THAT(show.output, HasSubstr("#   - The depth is that of the specimen."));
  EXPECT_TRUE(MessageDifferencer::Equals(parse_text_case(show.output, "shown"), preset_script().preset.case_()));
}

TEST(Materials, AreListedWithNumbersAndSources) {
  const FakeServer server(Script{});
  const ProgramResult list = server.run({"materials"});
  EXPECT_EQ(list.exit_code, 0) << list.errors;
  EXPECT_EQ(list.output, "\"Al 1\"  Aluminium of the tests\n  E 69000 MPa\n  - E: a handbook.\n");
  EXPECT_THAT(server.run({"materials", "--json"}).output, HasSubstr("\"name\":\"Al 1\""));
}

TEST(Presets, JsonIsOneObjectWithTheProtosNames) {
  const FakeServer server(preset_script());
  const ProgramResult show = server.run({"show", "preset:type-i", "--json"});
  const auto preset = from_json<v1::Preset>(show.output);
  EXPECT_TRUE(MessageDifferencer::Equals(preset, preset_script().preset));
  EXPECT_THAT(show.output, HasSubstr("\"speed_m_per_s\":100"));
}

TEST(Check, PrintsATableWithUnitsOfTheCaseWithItsSettings) {
  Script script = preset_script();
  script.check = from_text<v1::CheckCaseResponse>(R"(
    particle_count: 8099 element_count: 9642 mass_g: 72.1534 stable_step_s: 2.31e-7 predicted_seconds: 49.6
    predicted_bytes: 6543210 theory { gibson_ashby_mpa: 0.3012 }
    modelled: "Contact is looked for between walls of the same cell.")");
  const FakeServer server(script);
  const ProgramResult result = server.run({"check", "preset:type-i", "--set", "loading.speed_m_per_s=250"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  expect_parts_in(result.output, {"8099", "9642", "72.15  g", "2.310e-07  s", "50 s", "6.54 MB", "0.301  MPa",
                                  "  - Contact is looked for"});
  EXPECT_EQ(server.asked().checked.loading().speed_m_per_s(), 250.0);
}

TEST(Submit, SendsTheCaseWithIdAndLabelsAndPrintsTheJobsName) {
  const FakeServer server(preset_script());
  const ProgramResult result = server.run({"submit", "preset:type-i", "--set", "depth_mm=5", "--request-id", "abc",
                                           "--label", "who=me", "--label", "why=a=b"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, "jobs/test\n");
  const auto creates = server.asked().creates;
  ASSERT_EQ(creates.size(), 1U);
  EXPECT_EQ(creates[0].case_().depth_mm(), 5.0);
  EXPECT_EQ(creates[0].request_id(), "abc");
  EXPECT_EQ(creates[0].labels().at("who"), "me");
  EXPECT_EQ(creates[0].labels().at("why"), "a=b");
}

TEST(Submit, ReadsTextAndJsonFromStdinAndFiles) {
  const FakeServer server(preset_script());
  EXPECT_EQ(server.run({"submit", "-"}, "depth_mm: 4").exit_code, 0);
  EXPECT_EQ(server.run({"submit", "-"}, " {\"depth_mm\": 5}").exit_code, 0);
  const std::string file = (server.folder() / "case.json").string();
  std::ofstream(file) << R"({"depthMm": 6})";
  EXPECT_EQ(server.run({"submit", file}).exit_code, 0);
  const auto creates = server.asked().creates;
  ASSERT_EQ(creates.size(), 3U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(creates[static_cast<std::size_t>(i)].case_().depth_mm(), 4.0 + i);
}

TEST(Submit, WithWatchFollowsTheJob) {
  Script script = preset_script();
  script.job = make_job(v1::Job::RUNNING);
  script.events = make_events(5, v1::Job::FAILED);
  const FakeServer server(script);
  const ProgramResult result = server.run({"submit", "preset:type-i", "--watch"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.output.find("jobs/test\n"), 0U) << result.output;
  EXPECT_THAT(result.output, HasSubstr("SOLVER_DIVERGED"));
}

TEST(List, WalksOverAllPages) {
  const FakeServer server(preset_script());
  const ProgramResult text = server.run({"list"});
  EXPECT_EQ(text.exit_code, 0) << text.errors;
  EXPECT_THAT(text.output, HasSubstr("jobs/test  SUCCEEDED\njobs/test  SUCCEEDED\n"));
  EXPECT_THAT(text.output, HasSubstr("3.41 MPa"));
  const auto jobs = from_json<v1::ListJobsResponse>(server.run({"list", "--json"}).output);
  EXPECT_EQ(jobs.jobs_size(), 2);
}

TEST(List, PassesFilterAndOrderAndStopsAtTheLimit) {
  const FakeServer server(preset_script());
  const ProgramResult result = run_program(
      {"list", "--filter", "state = RUNNING", "--order", "create_time", "--limit", "1", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output.find("jobs/test"), result.output.rfind("jobs/test")) << result.output;
  const auto lists = server.asked().lists;
  ASSERT_EQ(lists.size(), 1U);
  EXPECT_EQ(lists[0].filter(), "state = RUNNING");
  EXPECT_EQ(lists[0].order_by(), "create_time");
  EXPECT_EQ(lists[0].page_size(), 1);
  EXPECT_EQ(server.run({"list", "--limit", "0"}).exit_code, 2);
}

TEST(List, ShowsLabelsWhereThereAreAny) {
  Script script = preset_script();
  const FakeServer plain(script);
  EXPECT_THAT(plain.run({"list"}).output, Not(HasSubstr("LABELS")));
  (*script.job.mutable_labels())["who"] = "me";
  (*script.job.mutable_labels())["batch"] = "7";
  const FakeServer labelled(script);
  const ProgramResult result = labelled.run({"list"});
  EXPECT_THAT(result.output, HasSubstr("LABELS"));
  EXPECT_THAT(result.output, HasSubstr("batch=7, who=me"));
}

TEST(Submit, RepeatsARequestWhoseAnswerWasLostUnderOneId) {
  Script script = preset_script();
  script.lost_creates = 2;
  const FakeServer server(script);
  const ProgramResult result = server.run({"submit", "preset:type-i"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, "jobs/test\n");
  const auto creates = server.asked().creates;
  ASSERT_EQ(creates.size(), 3U);
  EXPECT_GT(creates[0].request_id().size(), 30U);
  for (const auto& create : creates) EXPECT_EQ(create.request_id(), creates[0].request_id());
}

TEST(Submit, NamesTheCommandThatAsksAgainWhereTheAnswerStaysLost) {
  Script script = preset_script();
  script.lost_creates = 1000;
  const FakeServer server(script);
  const ProgramResult result = server.run({"submit", "preset:type-i", "--note", "it's new"});
  EXPECT_EQ(result.exit_code, 4);
  const auto creates = server.asked().creates;
  EXPECT_GT(creates.size(), 3U);
  EXPECT_THAT(result.errors, HasSubstr("run: cellcrush submit preset:type-i --note 'it'\\''s new' --server " +
                                       server.address() + " --request-id " + creates[0].request_id()));
}

TEST(Submit, SendsAPriorityAndRefusesOneOutOfRange) {
  const FakeServer server(preset_script());
  for (const char* priority : {"7", "-7"}) {
    const ProgramResult result = server.run({"submit", "preset:type-i", "--priority", priority});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
  }
  const auto creates = server.asked().creates;
  ASSERT_EQ(creates.size(), 2U);
  EXPECT_EQ(creates[0].priority(), 7);
  EXPECT_EQ(creates[1].priority(), -7);
  EXPECT_EQ(server.run({"submit", "preset:type-i", "--priority", "101"}).exit_code, 2);
}

TEST(ListAndShow, TellAPriorityOnlyWhereThereIsOne) {
  Script script = preset_script();
  const FakeServer plain(script);
  EXPECT_THAT(plain.run({"list"}).output, Not(HasSubstr("PRIORITY")));
  EXPECT_THAT(plain.run({"show", "jobs/test"}).output, Not(HasSubstr("priority")));
  script.job.set_priority(-12);
  script.job.set_retry_of("jobs/before");
  const FakeServer server(script);
  const ProgramResult list = server.run({"list"});
  EXPECT_THAT(list.output, HasSubstr("PRIORITY"));
  EXPECT_THAT(list.output, HasSubstr("PRIORITY -12"));
  const ProgramResult show = server.run({"show", "jobs/test"});
  EXPECT_THAT(show.output, HasSubstr("priority  -12"));
  EXPECT_THAT(show.output, HasSubstr("retry of  jobs/before"));
}

TEST(SubmitListAndShow, NameTheExecutorOnlyWhereItIsNotTheServersMachine) {
  Script script = preset_script();
  script.job.set_executor("local");
  const FakeServer plain(script);
  EXPECT_EQ(plain.run({"submit", "preset:type-i"}).exit_code, 0);
  EXPECT_EQ(plain.run({"submit", "preset:type-i", "--executor", "slurm/a"}).exit_code, 0);
  const auto creates = plain.asked().creates;
  ASSERT_EQ(creates.size(), 2U);
  EXPECT_EQ(creates[0].executor(), "");
  EXPECT_EQ(creates[1].executor(), "slurm/a");
  EXPECT_THAT(plain.run({"list"}).output, Not(HasSubstr("EXECUTOR")));
  EXPECT_THAT(plain.run({"show", "jobs/test"}).output, Not(HasSubstr("executor")));
  script.job.set_executor("slurm/a");
  script.job.set_place("Slurm job 17, PENDING (Priority)");
  const FakeServer server(script);
  const ProgramResult list = server.run({"list"});
  EXPECT_THAT(list.output, HasSubstr("EXECUTOR slurm/a"));
  EXPECT_THAT(list.output, HasSubstr("Slurm job 17, PENDING (Priority)"));
  const ProgramResult show = server.run({"show", "jobs/test"});
  EXPECT_THAT(show.output, HasSubstr("executor  slurm/a\n"));
  EXPECT_THAT(show.output, HasSubstr("place     Slurm job 17, PENDING (Priority)\n"));
}

TEST(Queue, IsATableInTheOrderOfTheStartsAndJson) {
  Script script = preset_script();
  v1::Queue& queue = script.queue.emplace();
  const FakeServer empty(script);
  EXPECT_EQ(empty.run({"queue"}).output, "the queue is empty\n");
  queue = from_text<v1::Queue>(R"(
    entries { job: "jobs/7" reason: "All 2 workers are busy." seconds_until_start: 64 }
    entries { job: "jobs/12" reason: "All 2 workers are busy." seconds_until_start: 64 })");
  const FakeServer server(script);
  EXPECT_EQ(server.run({"queue"}).output,
            "JOB       STARTS IN  REASON\n"
            "jobs/7   1 min 04 s  All 2 workers are busy.\n"
            "jobs/12  1 min 04 s  All 2 workers are busy.\n");
  queue.mutable_entries(0)->set_priority(3);
  queue.set_more_count(12'345);
  const FakeServer full(script);
  const ProgramResult table = full.run({"queue"});
  EXPECT_THAT(table.output, HasSubstr("PRIORITY  REASON\n"));
  EXPECT_THAT(table.output, HasSubstr("and 12 345 more\n"));
  const auto read = from_json<v1::Queue>(full.run({"queue", "--json"}).output);
  EXPECT_TRUE(MessageDifferencer::Equals(read, queue));
}

TEST(Cancel, NamesTheJobAndSaysHowItStands) {
  Script script = preset_script();
  script.changes_jobs = true;
  const FakeServer server(script);
  const ProgramResult cancel = server.run({"cancel", "test"});
  EXPECT_EQ(cancel.exit_code, 0) << cancel.errors;
  EXPECT_EQ(cancel.output, "jobs/test CANCELLING\n");
  EXPECT_EQ(server.asked().cancelled, std::vector<std::string>{"jobs/test"});
  EXPECT_EQ(server.run({"cancel", "none"}).exit_code, 5);
  EXPECT_EQ(server.run({"delete", "none"}).exit_code, 5);
}

TEST(Show, DescribesAJob) {
  const FakeServer server(preset_script());
  const ProgramResult result = server.run({"show", "jobs/test"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("hexagons, 74 x 21 cells, crushed along X at 100 m/s to strain 0.8"));
  EXPECT_THAT(result.output, HasSubstr("1970-01-01T00:16:40Z"));
}

}  // namespace
}  // namespace cellcrush::client::testing
