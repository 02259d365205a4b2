#include "help/help_formatter.h"

#include "help/wrapped_text.h"

namespace cellcrush::client {

namespace {

constexpr std::size_t kNameColumns = 28;
constexpr int kDescriptionColumns = 72;

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(kNameColumns);
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
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
  return wrap_text(option->get_description(), kDescriptionColumns);
}

}  // namespace cellcrush::client
