#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "programs/process.h"
#include "programs/temporary_folder.h"

namespace cellcrush::e2e {

/// Longest time that a command which does not wait for a job may take, on a slow and busy machine.
inline constexpr std::chrono::seconds kShortLimit{30};
/// Longest time that a small crush may take there.
inline constexpr std::chrono::seconds kCrushLimit{100};

/// A small case in protobuf text that is crushed within a second: 4 by 3 hexagons to 50 % strain.
std::string small_case();

/// A test with a temporary folder, and a cellcrushd of its own that listens on a Unix socket in it.
class DaemonTest : public ::testing::Test {
 protected:
  void SetUp() override { start_daemon(); }
  void TearDown() override;

  void start_daemon();
  /// Asks the daemon to end, and expects that it does so in order.
  void stop_daemon();

  /// Runs `cellcrush ARGUMENTS... --server ADDRESS`.
  [[nodiscard]] Outcome cellcrush(std::vector<std::string> arguments,
                                  std::chrono::milliseconds limit = kShortLimit) const;

  /// The command line of the same, for a process that runs beside the test.
  [[nodiscard]] std::vector<std::string> command(std::vector<std::string> arguments) const;

  /// Writes a file into the temporary folder and returns its path.
  [[nodiscard]] std::string write_file(const std::string& name, const std::string& text) const;

  [[nodiscard]] std::string address() const { return "unix:" + (folder() / "socket").string(); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] Process& daemon() const { return *daemon_; }

 private:
  cellcrush::testing::TemporaryFolder folder_;
  std::unique_ptr<Process> daemon_;
};

}  // namespace cellcrush::e2e
