// The program's help, and options before and after the command.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

std::string help_of(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  words.emplace_back("--help");
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result.output;
}

// Lines that begin with two spaces and `first`, a range of characters, without the spaces.
std::vector<std::string> indented_lines(const std::string& text, char first, char last) {
  std::vector<std::string> out;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.starts_with("  ") && line.size() > 2 && line[2] >= first && line[2] <= last) out.push_back(line.substr(2));
  }
  return out;
}

std::vector<std::string> commands_in_help() {
  std::vector<std::string> commands;
  for (const std::string& line : indented_lines(help_of({}), 'a', 'z')) {
    commands.push_back(line.substr(0, line.find(' ')));
  }
  return commands;
}

std::vector<std::string> examples_of(const std::string& command) {
  const std::string help = help_of({command});
  const std::size_t begin = help.find("\nExamples:\n");
  return begin == std::string::npos ? std::vector<std::string>() : indented_lines(help.substr(begin), 'a', 'z');
}

// The words of a command line without redirection; single quotes are taken off.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (const char character : line.substr(0, line.find(" > "))) {
    if (character == '\'') {
      quoted = !quoted;
    } else if (character == ' ' && !quoted) {
      words.emplace_back();
    } else {
      words.back() += character;
    }
  }
  return words;
}

// A folder with my.txtpb, the case that examples name; they run in it.
class Examples : public ::testing::Test {
 protected:
  Examples() : server_({}), before_(std::filesystem::current_path()) {
    std::filesystem::current_path(server_.folder());
    std::ofstream("my.txtpb") << "depth_mm: 4\n";
  }
  ~Examples() override { std::filesystem::current_path(before_); }

 private:
  FakeServer server_;
  std::filesystem::path before_;
};

TEST_F(Examples, EachCommandHasOneToThreeWhichItUnderstands) {
  const std::vector<std::string> commands = commands_in_help();
  EXPECT_GE(commands.size(), 17U);
  for (const std::string& command : commands) {
    const std::vector<std::string> examples = examples_of(command);
    EXPECT_GE(examples.size(), 1U) << command;
    EXPECT_LE(examples.size(), 3U) << command;
    for (const std::string& example : examples) {
      std::vector<std::string> words = words_of(example);
      ASSERT_GE(words.size(), 2U) << example;
      EXPECT_EQ(words[0], "cellcrush");
      EXPECT_EQ(words[1], command);
      words.erase(words.begin());
      // Refused only where it connects, or where ffmpeg is missing, with all else understood.
      words.insert(words.end(), {"--server", "nonsense"});
      const ProgramResult result = run_program(words);
      EXPECT_TRUE(result.exit_code == 0 || result.errors.find("\"nonsense\": expected") != std::string::npos ||
                  result.errors.find("Leave --server out") != std::string::npos ||
                  result.errors.find("ffmpeg is not installed") != std::string::npos)
          << example << "\n"
          << result.errors;
    }
  }
}

TEST(Help, ConnectionOptionsStandOnceInTheMainHelp) {
  const std::string help = help_of({});
  for (const char* option : {"  --server ", "  --tls-ca ", "  --tls-cert ", "  --tls-key ", "  --token-file "}) {
    EXPECT_GT(help.find(option), help.find("\nConnection:\n")) << option;
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
  for (const std::string& command : commands_in_help()) {
    const std::string text = help_of({command});
    EXPECT_EQ(text.find("\n  --server"), std::string::npos) << command;
    EXPECT_EQ(text.find("\n  --json"), std::string::npos) << command;
    EXPECT_NE(text.find("`cellcrush --help` describes --json and the connection options."), std::string::npos)
        << command;
  }
}

TEST(Help, LinesFitIntoAHundredColumns) {
  for (const std::string& command : commands_in_help()) {
    std::istringstream lines(help_of({command}));
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
    EXPECT_NE(before.errors.find("/nowhere/file: cannot be read"), std::string::npos) << before.errors;
  }
}

}  // namespace
}  // namespace cellcrush::client::testing
