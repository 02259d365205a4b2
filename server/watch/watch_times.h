#pragma once

#include <chrono>

namespace cellcrush::watch {

struct WatchTimes {
  /// Without an event, after which a watcher is sent a bookmark.
  std::chrono::milliseconds bookmark_interval{15'000};
  /// In which a watcher has taken no message, after which its watch is closed.
  std::chrono::milliseconds patience{600'000};
  /// In which a watcher that was closed may still take the reason; then the stream is reset.
  std::chrono::milliseconds grace{10'000};
};

}  // namespace cellcrush::watch
