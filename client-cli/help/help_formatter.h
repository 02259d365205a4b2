#pragma once

#include <CLI/CLI.hpp>

namespace cellcrush::client {

/// How --help looks: commands before options, each group of options a paragraph, descriptions wrapped to 100 columns.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option_desc(const CLI::Option* option) const override;

 private:
  std::string option_groups(const CLI::App* app) const;
};

}  // namespace cellcrush::client
