#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "e2e/process.h"

namespace cellcrush::testing {

/// A daemon_keeper with the daemon below it; both end with the object, and with the thread that made it.
using KeptDaemon = std::unique_ptr<e2e::Process>;

/// Starts a daemon in the foreground, with its output in the file `log`.
KeptDaemon start_daemon(const std::filesystem::path& log, const std::vector<std::string>& command);

/// Kills the daemon with everything below it; returns when all are gone. Does nothing when it is null.
void stop_daemon(KeptDaemon& daemon);

/// A free port of 127.0.0.1 that only a daemon of this test is given. Daemons that set SO_REUSEADDR can bind to it, as
/// this object does not listen.
class ReservedPort {
 public:
  /// Throws std::runtime_error when no port is free.
  ReservedPort();
  ~ReservedPort();
  ReservedPort(const ReservedPort&) = delete;
  ReservedPort& operator=(const ReservedPort&) = delete;

  [[nodiscard]] int number() const { return number_; }

 private:
  int socket_ = -1;
  int number_ = 0;
};

}  // namespace cellcrush::testing
