#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "chart/display_text.h"
#include "help/shell_files.h"
#include "usage/command_entries.h"

namespace cellcrush::client {

namespace {

constexpr int kPageColumns = 120;

constexpr const char* kHead =
    "<!-- Generated from the program. After a build, write this page again with\n"
    "     CELLCRUSH_WRITE_PAGES=1 build/ci/bin/docs_test --gtest_filter='CommandsPage.*' -->\n"
    "# Commands\n\n"
    "Reference of every command of `cellcrush`. It is made from the definition that the program parses with, as are\n"
    "`cellcrush COMMAND --help` and the man page `cellcrush(1)`. [README.md](README.md) lists the pages that show the\n"
    "commands at work.\n\n";

// Escapes text for Markdown. Text between backticks is already code.
std::string markdown(std::string_view text) {
  std::string out;
  bool is_code = false;
  for (const char character : text) {
    if (character == '`') is_code = !is_code;
    if (!is_code && (character == '*' || character == '<')) out += '\\';
    out += character;
  }
  return out;
}

// A paragraph or list item: the first line begins with `bullet`, the others are indented to its text.
std::string block(const std::string& bullet, const std::string& text) {
  std::string out;
  const int width = static_cast<int>(bullet.size());
  for (const std::string& line : wrap_words(text, kPageColumns - width)) {
    out += (out.empty() ? bullet : std::string(bullet.size(), ' ')) + line + '\n';
  }
  return out;
}

std::string item(const std::string& names, const std::string& description) {
  return block("* ", "`" + names + "`: " + markdown(description) + ".");
}

std::string option_items(const CLI::App& app, const std::string& group) {
  std::string text;
  for (const OptionEntry& option : option_entries(app)) {
    if (option.group != group || option.names.back() == "--help") continue;
    const std::string value = option.value.empty() ? "" : " " + option.value;
    const std::string limits = option.limits.empty() ? "" : "; " + option.limits;
    text += item(fmt::format("{}{}", fmt::join(option.names, ", "), value),
                 option.description + limits + (option.required ? "; required" : ""));
  }
  return text;
}

// The command lines under "Examples:" in the footer of a command.
std::string examples(const std::string& footer) {
  std::istringstream lines(footer);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ")) text += line.substr(2) + '\n';
  }
  return text.empty() ? "" : "\nExamples:\n\n```sh\n" + text + "```\n";
}

std::string command_section(const CLI::App& command) {
  const std::string& name = command.get_name();
  const std::vector<ArgumentEntry> arguments = argument_entries(command);
  std::string text = fmt::format("\n### {}\n\n{}\n```text\ncellcrush {} [OPTIONS]", name,
                                 block("", markdown(command.get_description() + ".")), name);
  for (const ArgumentEntry& argument : arguments) text += " " + argument.name;
  text += "\n```\n";
  std::string items;
  for (const ArgumentEntry& argument : arguments) items += item(argument.name, argument.description);
  for (const std::string& group : command.get_groups()) items += option_items(command, group);
  if (!items.empty()) text += "\n" + items;
  return text + examples(command.get_footer());
}

// The groups of commands, in the order of the help.
std::vector<std::string> command_groups(const CLI::App& app) {
  std::vector<std::string> groups;
  for (const CLI::App* command : visible_commands(app)) {
    if (std::find(groups.begin(), groups.end(), command->get_group()) == groups.end()) {
      groups.push_back(command->get_group());
    }
  }
  return groups;
}

}  // namespace

std::string command_page(const CLI::App& app) {
  std::string text = std::string(kHead) + "```text\ncellcrush [OPTIONS] COMMAND ...\n\n" +
                     wrap_text(app.get_footer(), kPageColumns) +
                     "\n```\n\n## Options of every command\n\n"
                     "* `-h, --help`: Print the help of the program, or of the command before it.\n";
  for (const std::string& group : app.get_groups()) text += option_items(app, group);
  for (const std::string& group : command_groups(app)) {
    text += "\n## " + group + '\n';
    for (const CLI::App* command : visible_commands(app)) {
      if (command->get_group() == group) text += command_section(*command);
    }
  }
  return text;
}

}  // namespace cellcrush::client
