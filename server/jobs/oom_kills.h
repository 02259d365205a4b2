#pragma once

#include <cstdint>
#include <functional>

namespace cellcrush::jobs {

/// Number of processes that the kernel has killed for lack of memory.
using OomKills = std::function<std::uint64_t()>;

/// Counts OOM kills in this process's control group, which its workers share (memory.events). Without one it counts
/// those of the machine (/proc/vmstat). 0 if neither can be read. Thread-safe.
std::uint64_t count_oom_kills();

}  // namespace cellcrush::jobs
