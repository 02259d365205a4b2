#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "programs/temporary_folder.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"

namespace cellcrush::testing {

/// Whether faults are made as often as a claim asks for: when CELLCRUSH_FAULT_ROUNDS is "full", as under the label
/// `long`.
inline bool is_full_round() {
  const char* value = std::getenv("CELLCRUSH_FAULT_ROUNDS");
  return value != nullptr && std::string_view(value) == "full";
}

/// How often a fault is made.
inline int rounds(int few, int full) { return is_full_round() ? full : few; }

/// A client that tries to connect again within a tenth of a second, and shares its connection with nobody. Its calls
/// are to wait for the connection (wait_for_ready): between calls gRPC looks after it only every five seconds.
Client impatient_client(const std::string& address);

/// All jobs, by name.
std::map<std::string, v1::Job> all_jobs(Client& client);

/// Makes a data folder whose journal has `count` PENDING jobs of the case, numbered from 1, as CreateJob leaves them.
void fill_journal(const std::filesystem::path& data_folder, std::int64_t count, const v1::Case& submitted);

/// A daemon as a process, which is killed and started again on the same folder. No process is left at the end.
class FaultFixture : public ::testing::Test {
 protected:
  void TearDown() override;

  /// Starts a daemon and waits until it serves; fails the test when it does not within 30 s.
  void start_daemon(const std::vector<std::string>& more_arguments = {});
  /// Without waiting for it.
  void begin_daemon(const std::vector<std::string>& more_arguments = {});
  /// SIGKILL. Its workers go on.
  void kill_daemon();
  /// SIGTERM, and the whole of what it wrote in its log.
  std::string stop_daemon();

  [[nodiscard]] Client client() const { return impatient_client(address()); }
  [[nodiscard]] std::string address() const { return "unix:" + (folder_.path() / "socket").string(); }
  [[nodiscard]] std::filesystem::path data_folder() const { return folder_.path() / "data"; }
  [[nodiscard]] std::filesystem::path journal() const { return data_folder() / "journal.sqlite"; }

  TemporaryFolder folder_;
  std::unique_ptr<DaemonProcess> daemon_;
};

}  // namespace cellcrush::testing
