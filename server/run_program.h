#pragma once

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

/// What a program did.
struct ProgramEnd {
  std::optional<int> exit_code;  ///< nothing: it was killed, by a signal or after the time limit
  bool timed_out = false;
  std::string output;  ///< its standard output, at most 64 MiB
  std::string errors;  ///< its standard error, at most 64 MiB

  [[nodiscard]] bool is_good() const { return exit_code == 0; }
};

/// Where a program finds more_input.
inline constexpr const char* kMoreInput = "/dev/fd/3";

/// Runs a program, found by PATH unless its name has a slash, and kills its process group once `limit` has passed or a
/// stop is requested. It reads `input`, and `more_input` from kMoreInput; empty: nothing. Thread-safe. Throws
/// std::system_error if it cannot be started.
ProgramEnd run_program(const std::vector<std::string>& command, std::chrono::milliseconds limit,
                       const std::stop_token& stop = {}, std::string_view input = {}, std::string_view more_input = {});

/// Several lines as one.
std::string in_one_line(const std::string& text);

/// How the program failed, as a sentence: what it said, or its exit code.
std::string what_failed(const std::string& command, const ProgramEnd& end);

}  // namespace cellcrush
