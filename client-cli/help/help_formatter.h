#pragma once

#include <CLI/CLI.hpp>

namespace cellcrush::client {

/// Layout of --help: commands before options, one paragraph per group of options, lines as wide as the terminal but at
/// most 100 columns.
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
