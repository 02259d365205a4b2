#pragma once

#include <chrono>

namespace cellcrush::client {

/// Catches the first Ctrl-C (SIGINT) and the first SIGTERM while it lives, so that a watch can end properly; a second
/// one ends the program as usual. At most one may exist at a time. wait_for may be called from any thread.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Waits at most `time` for a signal; returns whether one has arrived, now or before.
  [[nodiscard]] bool wait_for(std::chrono::milliseconds time) const;

  [[nodiscard]] bool requested() const { return wait_for(std::chrono::milliseconds(0)); }
};

}  // namespace cellcrush::client
