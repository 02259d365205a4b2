#include "parallel/cache_size.h"

#include <unistd.h>

#include <algorithm>

namespace cellcrush {
namespace {

constexpr std::size_t kMostOfOneProcess = std::size_t{32} << 20;

}  // namespace

std::size_t last_cache_bytes() {
  static const std::size_t kBytes = [] {
    const long found = sysconf(_SC_LEVEL3_CACHE_SIZE);
    return found > 0 ? std::min(static_cast<std::size_t>(found), kMostOfOneProcess) : kMostOfOneProcess;
  }();
  return kBytes;
}

}  // namespace cellcrush
