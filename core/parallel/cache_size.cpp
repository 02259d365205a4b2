#include "parallel/cache_size.h"

#include <unistd.h>

namespace cellcrush {

std::size_t last_cache_bytes() {
  static const std::size_t kBytes = [] {
    const long found = sysconf(_SC_LEVEL3_CACHE_SIZE);
    return found > 0 ? static_cast<std::size_t>(found) : std::size_t{32} << 20;
  }();
  return kBytes;
}

}  // namespace cellcrush
