#pragma once

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace cellcrush::slurm {

/// What a program did.
struct ProgramEnd {
  std::optional<int> exit_code;  ///< nothing: it was killed, by a signal or after the time limit
  bool timed_out = false;
  std::string output;  ///< its standard output, at most 64 MiB
  std::string errors;  ///< its standard error, at most 64 MiB

  [[nodiscard]] bool is_good() const { return exit_code == 0; }
};

/// Runs a program, found by PATH unless its name has a slash, and kills its process group once `limit` has passed or a
/// stop is requested. Thread-safe. Throws std::system_error if it cannot be started.
ProgramEnd run_program(const std::vector<std::string>& command, std::chrono::milliseconds limit,
                       const std::stop_token& stop = {});

}  // namespace cellcrush::slurm
