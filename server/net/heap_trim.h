#pragma once

#include <cstddef>

namespace cellcrush::net {

/// Returns memory to the system after a flood of connections and streams. The C library would otherwise keep its peak.
/// Not thread-safe.
class HeapTrim {
 public:
  /// Called about once a second with the number of open connections and streams. Returns whether memory was returned:
  /// once, after at least half of a large number has closed.
  bool note(std::size_t open);

 private:
  std::size_t most_ = 0;  ///< peak since memory was last returned
};

}  // namespace cellcrush::net
