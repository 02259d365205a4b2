#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

namespace cellcrush {

/// cellcrushd backup | verify | restore | import: operations on a data folder that do not start the service. Outlives
/// the parsing of `app`.
class StoreCommands {
 public:
  explicit StoreCommands(CLI::App& app);
  StoreCommands(const StoreCommands&) = delete;
  StoreCommands& operator=(const StoreCommands&) = delete;

  /// Whether one of the commands was given; valid once the app has parsed.
  [[nodiscard]] bool given() const;

  /// Runs the command. `data_folder` is the value of --data; empty without. Returns the exit code: 0 success, 1 failure
  /// or a problem found, 2 usage. Failures are described on stderr.
  [[nodiscard]] int run(const std::filesystem::path& data_folder) const;

 private:
  [[nodiscard]] int backup(const std::filesystem::path& data_folder) const;
  [[nodiscard]] int verify() const;
  [[nodiscard]] int restore(const std::filesystem::path& data_folder) const;
  [[nodiscard]] int import(const std::filesystem::path& data_folder) const;

  CLI::App* backup_;
  CLI::App* verify_;
  CLI::App* restore_;
  CLI::App* import_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  bool link_ = false;
};

}  // namespace cellcrush
