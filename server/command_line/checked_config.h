#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <vector>

namespace cellcrush {

/// Reads a file of options in TOML, and refuses it for a key that is no option: a slip would otherwise leave a default
/// in force unseen. Throws CLI::ConfigError with the nearest option's name, or with where all of them stand.
class CheckedConfig final : public CLI::ConfigTOML {
 public:
  /// `app`, whose options may be given, outlives this object.
  explicit CheckedConfig(const CLI::App& app) : app_(app) {}

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

 private:
  const CLI::App& app_;
};

}  // namespace cellcrush
