#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <vector>

namespace cellcrush {

/// Reads a TOML file of options and rejects a key that is not an option. Otherwise a misspelt key would silently leave
/// a default in force. Throws CLI::ConfigError with the nearest option name, or with where all options are listed.
class CheckedConfig final : public CLI::ConfigTOML {
 public:
  /// `app` defines the options and outlives this object.
  explicit CheckedConfig(const CLI::App& app) : app_(app) {}

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

 private:
  const CLI::App& app_;
};

}  // namespace cellcrush
