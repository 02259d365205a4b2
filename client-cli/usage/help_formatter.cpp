#include "usage/help_formatter.h"

#include <algorithm>
#include <sstream>

#include "chart/display_text.h"

namespace cellcrush {

namespace {

// Descriptions stand beside the names, or below them where the terminal is narrow.
constexpr int kNameColumns = 28;
constexpr int kNarrowNameColumns = 6;
constexpr int kNarrow = 70;

// Lines that are too long are broken; examples, which are indented, are not.
std::string wrap_lines(const std::string& text, int width) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    out += (line.starts_with(' ') || line.empty() ? line : client::wrap_text(line, width)) + '\n';
  }
  return out;
}

}  // namespace

HelpFormatter::HelpFormatter(int width) : width_(width) {
  column_width(static_cast<std::size_t>(width_ < kNarrow ? kNarrowNameColumns : kNameColumns));
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
  label("Subcommands", "Commands");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) +
         make_subcommands(app, mode) + option_groups(app) + '\n' + make_footer(app);
}

std::string HelpFormatter::option_groups(const CLI::App* app) const {
  std::string text;
  for (const std::string& group : app->get_groups()) {
    const auto options = app->get_options(
        [&group](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
    if (!group.empty() && !options.empty()) text += make_group(group, false, options);
  }
  return text;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return client::wrap_text(option->get_description(), description_columns());
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_name(),
                           client::wrap_text(command->get_description(), description_columns()), get_column_width());
  return out.str();
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrap_lines(app->get_description(), width_);
}

std::string HelpFormatter::make_footer(const CLI::App* app) const { return wrap_lines(app->get_footer(), width_); }

int HelpFormatter::description_columns() const { return std::max(width_ - static_cast<int>(get_column_width()), 20); }

}  // namespace cellcrush
