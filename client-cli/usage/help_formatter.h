#pragma once

#include <CLI/CLI.hpp>

namespace cellcrush {

/// Layout of --help in lines of at most `width` columns: commands before options, one paragraph per group of options.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(int width);

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

}  // namespace cellcrush
