#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <fstream>

#include "fake_server.h"
#include "google/rpc/status.pb.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using google::protobuf::util::JsonStringToMessage;

v1::ProblemList two_problems() {
  v1::ProblemList problems;
  v1::Problem& speed = *problems.add_problems();
  speed.set_field("loading.speed_m_per_s");
  speed.set_value("0");
  speed.set_message("must be above 0");
  speed.set_remedy("give a speed such as 100");
  v1::Problem& depth = *problems.add_problems();
  depth.set_field("depth_mm");
  depth.set_message("is missing");
  return problems;
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
    const ProgramResult result = run_program({command, "-", "--server", server.address()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "");
    for (const char* part :
         {"the case has 2 problems", "loading.speed_m_per_s = 0: must be above 0\n    Remedy: give a speed such as 100",
          "depth_mm: is missing"}) {
      EXPECT_NE(result.errors.find(part), std::string::npos) << part << "\n" << result.errors;
    }
  }
}

TEST(Refusal, WithJsonTheProblemsAreAnObject) {
  const FakeServer server(refusing_script());
  const ProgramResult submit = run_program({"submit", "-", "--json", "--server", server.address()});
  EXPECT_EQ(submit.exit_code, 2);
  v1::ProblemList problems;
  ASSERT_TRUE(JsonStringToMessage(submit.output, &problems).ok()) << submit.output;
  EXPECT_EQ(problems.problems_size(), 2);
  const ProgramResult check = run_program({"check", "-", "--json", "--server", server.address()});
  EXPECT_EQ(check.exit_code, 2);
  v1::CheckCaseResponse response;
  ASSERT_TRUE(JsonStringToMessage(check.output, &response).ok()) << check.output;
  EXPECT_EQ(response.problems(1).field(), "depth_mm");
}

TEST(Refusal, BadFilesAndSettingsEndWithTwo) {
  const FakeServer server(refusing_script());
  const std::string misspelt = (server.folder() / "bad.txtpb").string();
  std::ofstream(misspelt) << "loading {\n  sped_m_per_s: 5\n}\n";
  const ProgramResult file = run_program({"check", misspelt, "--server", server.address()});
  EXPECT_EQ(file.exit_code, 2);
  EXPECT_NE(file.errors.find(misspelt + ":2:"), std::string::npos) << file.errors;
  EXPECT_EQ(run_program({"check", "/nowhere/case", "--server", server.address()}).exit_code, 2);
  EXPECT_EQ(run_program({"check", server.folder().string(), "--server", server.address()}).exit_code, 2);
  const ProgramResult set =
      run_program({"check", "-", "--set", "loading.sped_m_per_s=1", "--server", server.address()});
  EXPECT_EQ(set.exit_code, 2);
  EXPECT_NE(set.errors.find("did you mean \"speed_m_per_s\""), std::string::npos);
}

TEST(Refusal, UsageErrorsEndWithTwo) {
  EXPECT_EQ(run_program({"--json"}).exit_code, 2);
  EXPECT_EQ(run_program({"crush"}).exit_code, 2);
  EXPECT_EQ(run_program({"check"}).exit_code, 2);
  EXPECT_EQ(run_program({"list", "--server", "nonsense"}).exit_code, 2);
  EXPECT_EQ(run_program({"list", "--server", "host:99999"}).exit_code, 2);
  EXPECT_EQ(run_program({"submit", "-", "--label", "x", "--server", "unix:/none"}).exit_code, 2);
  EXPECT_EQ(run_program({"--help"}).exit_code, 0);
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
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.end(), {"--server", server.address()});
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_NE(result.errors.find("not implemented by this server"), std::string::npos) << words[0] << result.errors;
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
    const ProgramResult result = run_program({command, file, "--server", server.address()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.errors.find("the message limit of 4 MiB (4194304 bytes)"), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("the request has "), std::string::npos);
  }
  EXPECT_TRUE(server.asked().creates.empty());
}

TEST(Refusal, AServersOwnLimitOfAMessageEndsWithTwo) {
  Script script = refusing_script();
  script.message_limit = 100000;
  const FakeServer server(script);
  const std::string file = (server.folder() / "long.txtpb").string();
  write_long_case(file, 5000);
  const ProgramResult result = run_program({"submit", file, "--server", server.address()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("the message is over the size limit"), std::string::npos) << result.errors;
  EXPECT_NE(result.errors.find("100000"), std::string::npos) << result.errors;
}

TEST(Refusal, AnEndlessCaseFileIsNotReadToItsEnd) {
  const FakeServer server(refusing_script());
  const ProgramResult result = run_program({"check", "/dev/zero", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("the limit of a case is 4 MiB"), std::string::npos) << result.errors;
}

TEST(Refusal, UnknownNamesEndWithFive) {
  const FakeServer server(refusing_script());
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"show", "preset:none"},
                                             {"show", "jobs/none"},
                                             {"fetch", "none", "-o", server.folder() / "x"},
                                             {"plot", "none", "-o", server.folder() / "x.png"}}) {
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.end(), {"--server", server.address()});
    EXPECT_EQ(run_program(arguments).exit_code, 5) << words[0] << " " << words[1];
  }
}

TEST(Refusal, AnUnknownPresetAsACaseIsAWrongCase) {
  const FakeServer server(refusing_script());
  for (const char* command : {"check", "submit"}) {
    const auto result = run_program({command, "preset:none", "--server", server.address()});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_NE(result.errors.find("none"), std::string::npos) << result.errors;
  }
}

TEST(NoServer, EndsWithThreeWithinTwoSeconds) {
  for (const char* address : {"unix:/tmp/cellcrush-no-such-socket", "127.0.0.1:1"}) {
    const ProgramResult result = run_program({"list", "--json", "--server", address});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_LT(result.seconds, 2.0);
    EXPECT_NE(result.errors.find("no server answers at"), std::string::npos) << result.errors;
    google::rpc::Status status;
    ASSERT_TRUE(JsonStringToMessage(result.output, &status).ok()) << result.output;
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
