#include "usage/man_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

#include "usage/command_entries.h"

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

std::string command_section(const CLI::App& app, const CLI::App& command) {
  std::string text =
      fmt::format(".SS \"{} {} [OPTIONS] {}\"\n{}\n", app.get_name(), roff(command.get_name()),
                  roff(fmt::format("{}", fmt::join(argument_names(command), " "))), roff(command.get_description()));
  for (const ArgumentEntry& argument : argument_entries(command))
    text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(argument.name), roff(argument.description));
  text += options_section(command);
  return command.get_footer().empty() ? text : text + ".PP\n" + roff_lines(command.get_footer());
}

}  // namespace

std::string man_page(const CLI::App& app, const ManPage& page) {
  std::string title = app.get_name();
  std::transform(title.begin(), title.end(), title.begin(), [](unsigned char letter) { return std::toupper(letter); });
  std::string commands;
  for (const CLI::App* command : visible_commands(app)) commands += command_section(app, *command);
  return fmt::format(
      ".TH {} {} \"\" \"cellcrush {}\" \"{}\"\n"
      ".SH NAME\n{} \\- {}\n"
      ".SH SYNOPSIS\n.B {}\n{}\n"
      ".SH DESCRIPTION\n{}\n.PP\n{}"
      ".SH OPTIONS\n{}"
      ".SH COMMANDS\n{}"
      ".SH SEE ALSO\n.BR {}\n",
      title, page.section, roff(page.version), page.manual, app.get_name(), page.summary, app.get_name(), page.synopsis,
      roff(app.get_description()), roff_lines(app.get_footer()), options_section(app), commands, page.see_also);
}

}  // namespace cellcrush
