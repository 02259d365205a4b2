#include "command_line/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace cellcrush {
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

// One paragraph per line.
std::string paragraphs(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    out += ".PP\n" + roff(text.substr(0, end)) + "\n";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

// "TEXT" of "TEXT:{read,submit,admin}", "INT" of "INT:INT in [1 - 1024]"; nothing of a flag.
std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_size() == 0 ? "" : option.get_type_name();
  return type.substr(0, type.find(':'));
}

std::string option_entry(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += "\\fB" + roff("-" + name) + "\\fR, ";
  for (const std::string& name : option.get_lnames()) names += "\\fB" + roff("--" + name) + "\\fR, ";
  if (names.empty()) names = "\\fI" + roff(option.get_name(true)) + "\\fR, ";
  names.resize(names.size() - 2);
  const std::string value = option.nonpositional() ? value_name(option) : "";
  return ".TP\n" + names + (value.empty() ? "" : " \\fI" + roff(value) + "\\fR") + "\n" +
         roff(option.get_description()) + "\n";
}

std::string option_entries(const CLI::App& app, bool positional) {
  std::string out;
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional() != positional) out += option_entry(*option);
  }
  return out;
}

std::string command_section(const CLI::App& command) {
  std::string arguments;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->nonpositional()) arguments += " " + option->get_name(true);
  }
  return fmt::format(".SS \"cellcrushd {} [OPTIONS]{}\"\n{}\n{}{}", roff(command.get_name()), roff(arguments),
                     roff(command.get_description()), option_entries(command, true), option_entries(command, false));
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    commands += command_section(*command);
  return fmt::format(
      ".TH CELLCRUSHD 8 \"\" \"cellcrush {}\" \"System Administration\"\n"
      ".SH NAME\ncellcrushd \\- daemon that runs crushing analyses of cellular materials\n"
      ".SH SYNOPSIS\n.B cellcrushd\n[OPTIONS] [COMMAND ...]\n"
      ".SH DESCRIPTION\n{}\n{}"
      ".SH OPTIONS\n{}"
      ".SH COMMANDS\n{}"
      ".SH SEE ALSO\n.BR cellcrush (1)\n",
      roff(version), roff(app.get_description()), paragraphs(app.get_footer()), option_entries(app, false), commands);
}

}  // namespace cellcrush
