#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace cellcrush {

/// cellcrushd backup | verify | restore: what is done to a data folder without serving it. Outlives the parsing of the
/// app it is given.
class StoreCommands {
 public:
  explicit StoreCommands(CLI::App& app);
  StoreCommands(const StoreCommands&) = delete;
  StoreCommands& operator=(const StoreCommands&) = delete;

  /// Whether one of them was given, once the app has parsed.
  [[nodiscard]] bool given() const;

  /// Runs it; `data_folder` is that of --data, empty when there is none. The exit code: 0 done, 1 not done or something
  /// is wrong with what was looked at, 2 usage. Words about a failure go to stderr.
  [[nodiscard]] int run(const std::filesystem::path& data_folder) const;

 private:
  [[nodiscard]] int backup(const std::filesystem::path& data_folder) const;
  [[nodiscard]] int verify() const;
  [[nodiscard]] int restore(const std::filesystem::path& data_folder) const;

  CLI::App* backup_;
  CLI::App* verify_;
  CLI::App* restore_;
  std::filesystem::path folder_;
};

}  // namespace cellcrush
