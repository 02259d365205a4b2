#pragma once

#include <cstddef>

namespace cellcrush::net {

/// Gives memory back to the system after a flood: what thousands of connections and streams took stays with the C
/// library otherwise, and is never smaller than it was at the worst. Not thread-safe.
class HeapTrim {
 public:
  /// Called about once a second with the number of open connections and streams. Returns whether memory was given back:
  /// once, when at least half of a large number has gone.
  bool note(std::size_t open);

 private:
  std::size_t most_ = 0;  ///< since memory was given back last
};

}  // namespace cellcrush::net
