#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "daemon_options.h"

namespace cellcrush {

/// The flags of the daemon, on the command line and in the --config file. Outlives the parsing of `app`.
class DaemonFlags {
 public:
  explicit DaemonFlags(CLI::App& app);
  DaemonFlags(const DaemonFlags&) = delete;
  DaemonFlags& operator=(const DaemonFlags&) = delete;

  /// The options given; valid once the app has parsed them.
  [[nodiscard]] DaemonOptions options() const;

  /// "text" or "json".
  [[nodiscard]] const std::string& log_format() const { return log_format_; }
  /// Empty: stderr.
  [[nodiscard]] const std::filesystem::path& log_file() const { return log_file_; }

 private:
  void add_addresses(CLI::App& app);
  void add_access(CLI::App& app);
  void add_monitoring(CLI::App& app);
  void add_connections(CLI::App& app);
  void add_limits(CLI::App& app);
  void add_owner_limits(CLI::App& app);
  void add_storage(CLI::App& app);
  void add_times(CLI::App& app);

  DaemonOptions options_;
  std::vector<std::string> clusters_;
  std::vector<std::string> group_scopes_;
  std::string certificate_scope_ = "submit";
  std::string log_format_ = "text";
  std::filesystem::path log_file_;
  std::int64_t call_memory_mib_ = 256;
  std::int64_t memory_mib_ = 0;
  std::int64_t free_mib_ = 256;
  double job_seconds_ = 0.0;
  std::int64_t owner_disk_mib_ = 0;
  std::int64_t keep_mib_ = 0;
  double keep_days_ = 0.0;
  double checkpoint_seconds_ = 60.0;
  double patience_seconds_ = 600.0;
};

/// A TOML file of all options of the program, by their groups, each with its description and commented out; those of
/// `given`, key to value in TOML, are set. For packages: what it sets is what the service starts with.
std::string config_file(const CLI::App& app, const std::map<std::string, std::string>& given);

}  // namespace cellcrush
