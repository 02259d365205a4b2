#include "help/man_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <string_view>

#include "help/command_entries.h"

namespace cellcrush::client {

namespace {

// Escapes text for roff, also at the start of a line.
std::string roff(std::string_view text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char character : text) {
    if (character == '\\') {
      out += "\\e";
    } else if (character == '-') {
      out += "\\-";
    } else {
      out += character;
    }
  }
  return out;
}

// Preformatted lines, each on its own.
std::string roff_lines(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) out += line.empty() ? ".PP\n" : roff(line) + "\n.br\n";
  return out;
}

std::string options_section(const CLI::App& app) {
  std::string text;
  for (const OptionEntry& option : option_entries(app)) {
    std::string names;
    for (const std::string& name : option.names)
      names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    const std::string value = option.value.empty() ? "" : " \\fI" + roff(option.value) + "\\fR";
    text += fmt::format(".TP\n{}{}\n{}\n", names, value, roff(option.description));
  }
  return text;
}

std::string manual_section(const CLI::App& command) {
  return fmt::format(".SS \"cellcrush {} [OPTIONS] {}\"\n{}\n{}.PP\n{}", roff(command.get_name()),
                     roff(fmt::format("{}", fmt::join(argument_names(command), " "))), roff(command.get_description()),
                     options_section(command), roff_lines(command.get_footer()));
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string commands;
  for (const CLI::App* command : visible_commands(app)) commands += manual_section(*command);
  return fmt::format(
      ".TH CELLCRUSH 1 \"\" \"cellcrush {}\" \"User Commands\"\n"
      ".SH NAME\ncellcrush \\- simulate the in-plane crushing of honeycombs\n"
      ".SH SYNOPSIS\n.B cellcrush\n[OPTIONS] COMMAND ...\n"
      ".SH DESCRIPTION\n{}\n.PP\n{}"
      ".SH OPTIONS\n{}"
      ".SH COMMANDS\n{}",
      roff(version), roff(app.get_description()), roff_lines(app.get_footer()), options_section(app), commands);
}

}  // namespace cellcrush::client
