#pragma once

#include <cstdint>
#include <functional>

namespace cellcrush::jobs {

/// How many processes the kernel has killed for want of memory.
using OomKills = std::function<std::uint64_t()>;

/// Those of this process's control group, which its workers share (memory.events); where there is none, those of the
/// machine (/proc/vmstat). 0 where neither can be read. Thread-safe.
std::uint64_t count_oom_kills();

}  // namespace cellcrush::jobs
