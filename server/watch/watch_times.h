#pragma once

#include <chrono>

namespace cellcrush::watch {

struct WatchTimes {
  /// Idle time after which a watcher receives a bookmark.
  std::chrono::milliseconds bookmark_interval{15'000};
  /// Time without reading a message after which a watch is closed.
  std::chrono::milliseconds patience{600'000};
  /// Time after closing in which the watcher may still read the reason; then the stream is reset.
  std::chrono::milliseconds grace{10'000};
  /// The most that these may be while places are short, and a second of patience for each 100 kB.
  std::chrono::milliseconds patience_when_short{5'000};
  std::chrono::milliseconds grace_when_short{2'000};
};

}  // namespace cellcrush::watch
