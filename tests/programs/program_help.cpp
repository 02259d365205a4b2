#include "programs/program_help.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "programs/process.h"

namespace cellcrush::e2e {

std::string help_of(std::vector<std::string> command) {
  command.emplace_back("--help");
  const Outcome outcome = run(command, std::chrono::seconds(30));
  EXPECT_EQ(outcome.exit_code, 0) << command[0] << outcome.all();
  return outcome.output;
}

std::vector<std::string> help_entries(const std::string& help) {
  std::vector<std::string> out;
  std::istringstream lines(help);
  std::string line;
  while (std::getline(lines, line) && line != "Examples:") {
    if (!line.starts_with("  ")) continue;
    if (line[2] != ' ') {
      out.push_back(line);
    } else if (!out.empty()) {
      out.back() += line;
    }
  }
  return out;
}

std::set<std::string> options_of(const std::string& help) {
  static const std::regex kOption("--?[a-zA-Z][a-zA-Z0-9-]*");
  std::set<std::string> options;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos || (line[start] != '-' && !line.starts_with("usage:"))) continue;
    for (std::sregex_iterator match(line.begin(), line.end(), kOption), end; match != end; ++match)
      options.insert(match->str());
  }
  return options;
}

bool ProgramHelp::has(const std::string& option) const {
  return options.contains(option) ||
         std::ranges::any_of(commands, [&](const auto& command) { return command.second.contains(option); });
}

ProgramHelp read_help(const std::string& program) {
  const std::string text = help_of({program});
  ProgramHelp help{options_of(text), {}};
  for (const std::string& entry : help_entries(text)) {
    const std::string name = entry.substr(2, entry.find(' ', 2) - 2);
    if (name[0] >= 'a' && name[0] <= 'z') help.commands[name] = options_of(help_of({program, name}));
  }
  return help;
}

}  // namespace cellcrush::e2e
