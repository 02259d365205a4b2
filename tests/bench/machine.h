#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <string>

namespace cellcrush::bench {

/// Name of the processor, as the kernel tells it, without commas; "unknown" where it does not.
std::string processor_name();

/// Today, as 2001-12-31.
std::string today();

/// Processor time that this process has taken so far, s.
double processor_seconds();

/// Memory of this process: what it holds now, and the most that it held since its start. Bytes, of pages that are in
/// memory.
double resident_bytes();
double greatest_resident_bytes();

/// What measure() returns, taken in a process of its own, whose heap nobody else has used; none if that ended before.
template <class Measure>
auto measure_apart(const Measure& measure) -> std::optional<decltype(measure())> {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    const auto measured = measure();
    _exit(write(ends[1], &measured, sizeof(measured)) == sizeof(measured) ? 0 : 1);
  }
  close(ends[1]);
  decltype(measure()) measured;
  const bool told = child > 0 && read(ends[0], &measured, sizeof(measured)) == sizeof(measured);
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return told ? std::optional(measured) : std::nullopt;
}

/// A text that is another one for every other build of this program.
std::string build_name();

}  // namespace cellcrush::bench
