#include "net/connection_limits.h"

#include <malloc.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>

namespace cellcrush::net {
namespace {

// Journal, log, ports, event queues of gRPC and open results; for each worker its process, reports and folder.
constexpr std::int64_t kOfTheDaemon = 128;
constexpr std::int64_t kOfAWorker = 8;
constexpr int kLeast = 8;
// A hard limit may be 10^9, and some programs close every descriptor up to it.
constexpr rlim_t kMost = 1 << 20;
constexpr std::size_t kWorthReturning = 8 << 20;  // bytes

}  // namespace

int raise_descriptor_limit(int wanted, int workers) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return wanted;
  const rlim_t reachable = std::min(limit.rlim_max, kMost);
  if (limit.rlim_cur < reachable) {
    limit.rlim_cur = reachable;
    if (setrlimit(RLIMIT_NOFILE, &limit) != 0) getrlimit(RLIMIT_NOFILE, &limit);
  }
  const auto descriptors = static_cast<std::int64_t>(std::min(limit.rlim_cur, kMost));
  // TCP and Unix sockets count separately; a download also has a file.
  const std::int64_t left = (descriptors - kOfTheDaemon - kOfAWorker * workers) / 3;
  const int out = static_cast<int>(std::clamp<std::int64_t>(left, kLeast, wanted));
  if (out < wanted) {
    spdlog::warn(
        "At most {} connections can be open instead of {}: the limit on file descriptors is {}. Raise the hard limit "
        "(LimitNOFILE= of the service, ulimit -Hn)",
        out, wanted, descriptors);
  }
  return out;
}

void HeapTrim::look() {
  const std::size_t now = mallinfo2().fordblks;
  free_ = std::min(free_, now);
  if (now < free_ + kWorthReturning) return;
  malloc_trim(0);
  free_ = now;  // pages that were returned still count
}

}  // namespace cellcrush::net
