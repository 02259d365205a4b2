#include "worker/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <utility>

#include "allotment.h"
#include "worker/claim.h"

namespace cellcrush::worker {
namespace {

std::atomic<MemoryLimit*> limit_in_force;
thread_local bool is_ending = false;
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kCanLimit = false;  // the sanitizer reserves terabytes
#else
constexpr bool kCanLimit = true;
#endif
rlim_t newest_limit = RLIM_INFINITY;  // soft, also after it was lifted

rlimit data_limit() {
  rlimit out{};
  getrlimit(RLIMIT_DATA, &out);
  return out;
}

void set_soft_limit(rlim_t bytes) {
  rlimit limit = data_limit();
  limit.rlim_cur = std::min(bytes, limit.rlim_max);
  setrlimit(RLIMIT_DATA, &limit);
}

std::int64_t allowed_memory() {
  rlimit whole{};
  getrlimit(RLIMIT_AS, &whole);
  const rlim_t limits = std::min({whole.rlim_cur, data_limit().rlim_cur, newest_limit});
  return static_cast<std::int64_t>(std::min(limits, static_cast<rlim_t>(usable_memory())));
}

}  // namespace

// The handler of failed allocations.
void end_for_memory() {
  if (is_ending) throw std::bad_alloc();
  MemoryLimit* limit = limit_in_force.exchange(nullptr);
  // Another thread ends the process.
  while (limit == nullptr) pause();
  is_ending = true;
  set_soft_limit(RLIM_INFINITY);  // the report takes memory
  limit->ran_out_();
}

MemoryLimit::MemoryLimit(std::int64_t bytes, std::function<void()> ran_out) : ran_out_(std::move(ran_out)) {
  if (bytes <= 0 || !kCanLimit) return;
  set_soft_limit(static_cast<rlim_t>(bytes));
  newest_limit = data_limit().rlim_cur;
  limit_in_force = this;
  std::set_new_handler(end_for_memory);
}

MemoryLimit::~MemoryLimit() {
  std::set_new_handler(nullptr);
  limit_in_force = nullptr;
  set_soft_limit(RLIM_INFINITY);
}

Final out_of_memory() {
  const std::int64_t allowed = allowed_memory();
  set_soft_limit(RLIM_INFINITY);
  constexpr std::int64_t kMebibyte = 1024 * 1024;
  Final out;
  out.set_cause(v1::Job::OUT_OF_MEMORY);
  out.set_message(fmt::format("The run needs more than the {} MiB of memory that it was allowed; it used {} MiB.",
                              allowed / kMebibyte, peak_memory_of(getpid()) / kMebibyte));
  out.set_remedy(
      "Use fewer cells or elements_per_wall, or allow more memory: --max-job-memory of the daemon, ulimit -d and "
      "ulimit -v, or a machine with more.");
  return out;
}

}  // namespace cellcrush::worker
