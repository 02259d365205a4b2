#include "parallel/cache_size.h"

#include <unistd.h>

#include <algorithm>

namespace cellcrush {

std::size_t last_cache_bytes() {
  static const std::size_t kBytes = [] {
    constexpr std::size_t kMostOfOneProcess = std::size_t{32} << 20;
    const long found = sysconf(_SC_LEVEL3_CACHE_SIZE);
    return found > 0 ? std::min(static_cast<std::size_t>(found), kMostOfOneProcess) : kMostOfOneProcess;
  }();
  return kBytes;
}

}  // namespace cellcrush
