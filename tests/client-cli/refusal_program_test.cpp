#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "fake_server.h"
#include "google/rpc/status.pb.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;

v1::ProblemList two_problems() {
  return from_text<v1::ProblemList>(R"(
    problems { field: "loading.speed_m_per_s" value: "0" message: "must be above 0" remedy: "give a speed such as 100" }
    problems { field: "depth_mm" message: "is missing" })");
}

Script refusing_script() {
  Script script;
  script.job = make_job(v1::Job::RUNNING);
  google::rpc::Status envelope;
  envelope.add_details()->PackFrom(two_problems());
  script.create_status = grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "refused", envelope.SerializeAsString());
  *script.check.mutable_problems() = two_problems().problems();
  return script;
}

TEST(Refusal, AllProblemsAreShownWithPathsAndRemedies) {
  const FakeServer server(refusing_script());
  for (const char* command : {"submit", "check"}) {
    const ProgramResult result = server.run({command, "-"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "");
    expect_parts_in(result.errors, {"the case has 2 problems",
                                    "loading.speed_m_per_s = 0: must be above 0\n    Remedy: give a speed such as 100",
                                    "depth_mm: is missing"});
  }
}

TEST(Refusal, ProblemsOfAnotherPartOfTheRequestAreNotTheCases) {
  v1::ProblemList problems = two_problems();
  problems.mutable_problems(1)->set_field("filter");
  google::rpc::Status envelope;
  envelope.add_details()->PackFrom(problems);
  Script script;
  script.create_status = grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "refused", envelope.SerializeAsString());
  EXPECT_THAT(FakeServer(script).run({"submit", "-"}).errors, HasSubstr("the request has 2 problems"));
}

TEST(Refusal, WithJsonTheProblemsAreAnObject) {
  const FakeServer server(refusing_script());
  const ProgramResult submit = server.run({"submit", "-", "--json"});
  EXPECT_EQ(submit.exit_code, 2);
  const auto problems = from_json<v1::ProblemList>(submit.output);
  EXPECT_EQ(problems.problems_size(), 2);
  const ProgramResult check = server.run({"check", "-", "--json"});
  EXPECT_EQ(check.exit_code, 2);
  const auto response = from_json<v1::CheckCaseResponse>(check.output);
  EXPECT_EQ(response.problems(1).field(), "depth_mm");
}

TEST(Refusal, BadFilesAndSettingsEndWithTwo) {
  const FakeServer server(refusing_script());
  const std::string misspelt = (server.folder() / "bad.txtpb").string();
  std::ofstream(misspelt) << "loading {\n  sped_m_per_s: 5\n}\n";
  const ProgramResult file = server.run({"check", misspelt});
  EXPECT_EQ(file.exit_code, 2);
  EXPECT_THAT(file.errors, HasSubstr(misspelt + ":2:"));
  EXPECT_EQ(server.run({"check", "/nowhere/case"}).exit_code, 2);
  EXPECT_EQ(server.run({"check", server.folder().string()}).exit_code, 2);
  const ProgramResult set = server.run({"check", "-", "--set", "loading.sped_m_per_s=1"});
  EXPECT_EQ(set.exit_code, 2);
  EXPECT_THAT(set.errors, HasSubstr("did you mean \"speed_m_per_s\""));
}

TEST(Refusal, UsageErrorsEndWithTwo) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--json"},
                                             {"crush"},
                                             {"check"},
                                             {"list", "--server", "nonsense"},
                                             {"list", "--server", "host:99999"},
                                             {"submit", "-", "--label", "x", "--server", "unix:/none"}}) {
    EXPECT_EQ(run_program(words).exit_code, 2) << words.back();
  }
  EXPECT_EQ(run_program({"--help"}).exit_code, 0);
}

TEST(Refusal, EveryStatusHasItsExitCode) {
  using grpc::StatusCode;
  const std::pair<int, std::vector<StatusCode>> codes[] = {
      {2,
       {StatusCode::INVALID_ARGUMENT, StatusCode::FAILED_PRECONDITION, StatusCode::UNIMPLEMENTED,
        StatusCode::ALREADY_EXISTS, StatusCode::PERMISSION_DENIED, StatusCode::UNAUTHENTICATED,
        StatusCode::RESOURCE_EXHAUSTED, StatusCode::ABORTED, StatusCode::OUT_OF_RANGE}},
      {3, {StatusCode::UNAVAILABLE}},
      {4,
       {StatusCode::CANCELLED, StatusCode::DEADLINE_EXCEEDED, StatusCode::UNKNOWN, StatusCode::INTERNAL,
        StatusCode::DATA_LOSS}},
      {5, {StatusCode::NOT_FOUND}}};
  for (const auto& [exit_code, statuses] : codes) {
    for (const StatusCode status : statuses) {
      Script script;
      // What is in the details and no list of problems does no harm.
      script.create_status = grpc::Status(status, "bad", "\xff\xfe rubbish");
      const ProgramResult result = FakeServer(script).run({"submit", "-"});
      EXPECT_EQ(result.exit_code, exit_code) << status;
      EXPECT_THAT(result.errors, HasSubstr("bad"));
    }
  }
}

TEST(Refusal, WhatTheServerDoesNotDoEndsWithTwo) {
  const FakeServer server(refusing_script());
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"cancel", "jobs/test"},
                                             {"suspend", "jobs/test"},
                                             {"resume", "jobs/test"},
                                             {"delete", "jobs/test"},
                                             {"queue"},
                                             {"drain"},
                                             {"sweep", "-", "--over", "loading.speed_m_per_s=1,2"},
                                             {"retry", "a"},
                                             {"table", "a"}}) {
    const ProgramResult result = server.run(words);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_THAT(result.errors, HasSubstr("not implemented by this server"));
  }
}

// A frame of so many nodes, each of which takes about 40 bytes in a message.
void write_long_case(const std::string& file, int nodes) {
  std::ofstream stream(file);
  stream << "lattice { frame {\n";
  for (int i = 0; i < nodes; ++i) stream << "nodes { id: \"node-number-" << i << "\" x_mm: 0.1 y_mm: 0.2 }\n";
  stream << "} }\n";
}

TEST(Refusal, ARequestOverTheLimitOfAMessageIsNotSent) {
  const FakeServer server(refusing_script());
  const std::string file = (server.folder() / "long.txtpb").string();
  write_long_case(file, 120000);
  for (const char* command : {"submit", "check"}) {
    const ProgramResult result = server.run({command, file});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.errors, HasSubstr("the message limit of 4 MiB (4194304 bytes)"));
    EXPECT_THAT(result.errors, HasSubstr("the request has "));
  }
  EXPECT_TRUE(server.asked().creates.empty());
}

TEST(Refusal, AServersOwnLimitOfAMessageEndsWithTwo) {
  Script script = refusing_script();
  script.message_limit = 100000;
  const FakeServer server(script);
  const std::string file = (server.folder() / "long.txtpb").string();
  write_long_case(file, 5000);
  const ProgramResult result = server.run({"submit", file});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("the message is over the size limit"));
  EXPECT_THAT(result.errors, HasSubstr("100000"));
}

TEST(Refusal, AnEndlessCaseFileIsNotReadToItsEnd) {
  const FakeServer server(refusing_script());
  const ProgramResult result = server.run({"check", "/dev/zero"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("the limit of a case is 4 MiB"));
}

TEST(Refusal, UnknownNamesEndWithFive) {
  const FakeServer server(refusing_script());
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"show", "preset:none"},
                                             {"show", "jobs/none"},
                                             {"fetch", "none", "-o", server.folder() / "x"},
                                             {"plot", "none", "-o", server.folder() / "x.png"}}) {
    EXPECT_EQ(server.run(words).exit_code, 5) << words[0] << " " << words[1];
  }
}

TEST(Refusal, AnUnknownPresetAsACaseIsAWrongCase) {
  const FakeServer server(refusing_script());
  for (const char* command : {"check", "submit"}) {
    const auto result = server.run({command, "preset:none"});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.errors, HasSubstr("none"));
  }
}

TEST(NoServer, EndsWithThreeWithinTwoSeconds) {
  for (const char* address : {"unix:/tmp/cellcrush-no-such-socket", "127.0.0.1:1"}) {
    const ProgramResult result = run_program({"list", "--json", "--server", address});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_LT(result.seconds, 2.0);
    EXPECT_THAT(result.errors, HasSubstr("no server answers at"));
    const auto status = from_json<google::rpc::Status>(result.output);
    EXPECT_EQ(status.code(), grpc::StatusCode::UNAVAILABLE);
  }
}

TEST(Run, CtrlCBeforeTheCaseHasComeLeavesNothingBehind) {
  const FakeServer folder_of_its_own({});
  const std::filesystem::path folder = folder_of_its_own.folder() / "out";
  Program program({"run", "-", "-o", folder}, 80);
  program.type("depth_mm: 4\n");
  EXPECT_TRUE(program.wait_for_output("depth_mm"));
  usleep(300'000);
  program.interrupt();
  program.wait();
  EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace cellcrush::client::testing
