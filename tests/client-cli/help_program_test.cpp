// The program's help, and options before and after the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "fake_server.h"
#include "program.h"
#include "programs/program_help.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> commands_in_help() {
  std::vector<std::string> commands;
  for (const auto& [command, options] : e2e::read_help(CELLCRUSH_PROGRAM).commands) commands.push_back(command);
  return commands;
}

std::string help_of(const std::string& command) { return e2e::help_of({CELLCRUSH_PROGRAM, command}); }

std::vector<std::string> examples_of(const std::string& command) {
  const std::string help = help_of(command);
  const std::size_t begin = help.find("\nExamples:\n");
  if (begin == std::string::npos) return {};
  std::istringstream lines(help.substr(begin));
  std::vector<std::string> out;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  cellcrush ")) out.push_back(line.substr(2));
  }
  return out;
}

TEST(Examples, EachCommandHasOneToThreeWhichItUnderstands) {
  const FakeServer server({});
  std::ofstream(server.folder() / "my.txtpb") << "depth_mm: 4\n";
  std::ofstream(server.folder() / "foam.csv") << "x1,y1,x2,y2\n0,0,5,5\n5,5,0,9\n";
  const std::string begin = "cd '" + server.folder().string() + "' && PATH='" +
                            std::filesystem::path(CELLCRUSH_PROGRAM).parent_path().string() + "':$PATH && ";
  const std::vector<std::string> commands = commands_in_help();
  EXPECT_GE(commands.size(), 17U);
  for (const std::string& command : commands) {
    const std::vector<std::string> examples = examples_of(command);
    EXPECT_GE(examples.size(), 1U) << command;
    EXPECT_LE(examples.size(), 3U) << command;
    for (const std::string& example : examples) {
      EXPECT_TRUE((example + " ").starts_with("cellcrush " + command + " ")) << example;
      // Refused only where it connects, or where ffmpeg is missing, with all else understood.
      const e2e::Outcome result =
          e2e::run({"/bin/bash", "-c", begin + example + " --server nonsense"}, std::chrono::seconds(30));
      EXPECT_TRUE(result.exit_code == 0 || result.errors.find("\"nonsense\": expected") != std::string::npos ||
                  result.errors.find("Leave --server out") != std::string::npos ||
                  result.errors.find("ffmpeg is not installed") != std::string::npos)
          << example << "\n"
          << result.errors;
    }
  }
}

TEST(Help, ConnectionOptionsStandOnceInTheMainHelp) {
  const std::string help = e2e::help_of({CELLCRUSH_PROGRAM});
  for (const char* option : {"  --server ", "  --tls-ca ", "  --tls-cert ", "  --tls-key ", "  --token-file "}) {
    EXPECT_GT(help.find(option), help.find("\nConnection:\n")) << option;
    EXPECT_THAT(help, HasSubstr(option));
  }
  for (const std::string& command : commands_in_help()) {
    const std::string text = help_of(command);
    EXPECT_THAT(text, Not(HasSubstr("\n  --server")));
    EXPECT_THAT(text, Not(HasSubstr("\n  --json")));
    EXPECT_THAT(text, HasSubstr("`cellcrush --help` describes --json and the connection options."));
  }
}

TEST(Help, LinesFitIntoAHundredColumns) {
  for (const std::string& command : commands_in_help()) {
    std::istringstream lines(help_of(command));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  }
}

TEST(SharedOptions, StandBeforeAndAfterTheCommand) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  const FakeServer server(script);
  const ProgramResult after = run_program({"list", "--server", server.address(), "--json"});
  EXPECT_EQ(after.exit_code, 0) << after.errors;
  EXPECT_EQ(after.output.front(), '{');
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--server", server.address(), "--json", "list"},
           {"--json", "list", "--server", server.address()},
           {"--server", "unix:/nowhere", "list", "--server", server.address(), "--json"}}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.output, after.output);
  }
}

TEST(SharedOptions, CredentialsStandBeforeAndAfterTheCommand) {
  for (const char* option : {"--tls-ca", "--token-file"}) {
    const ProgramResult before = run_program({option, "/nowhere/file", "list", "--server", "127.0.0.1:1"});
    const ProgramResult after = run_program({"list", option, "/nowhere/file", "--server", "127.0.0.1:1"});
    EXPECT_EQ(before.exit_code, 2);
    EXPECT_EQ(before.errors, after.errors);
    EXPECT_THAT(before.errors, HasSubstr("/nowhere/file: cannot be read"));
  }
}

}  // namespace
}  // namespace cellcrush::client::testing
