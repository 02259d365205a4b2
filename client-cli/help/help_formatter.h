#pragma once

#include <CLI/CLI.hpp>

namespace cellcrush::client {

/// How --help looks: commands before options, each group of options a paragraph, lines of the terminal's width, of 100
/// columns at most.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  std::string option_groups(const CLI::App* app) const;
  int description_columns() const;

  int width_;
};

}  // namespace cellcrush::client
