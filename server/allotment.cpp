#include "allotment.h"

#include <absl/strings/numbers.h>
#include <absl/strings/str_split.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

namespace cellcrush {
namespace {

namespace fs = std::filesystem;

std::optional<double> read_number(const fs::path& path) {
  std::ifstream file(path);
  double out = 0.0;
  return file >> out ? std::optional(out) : std::nullopt;
}

// The limits of one group; none where it has none.
std::optional<double> cores_of(const fs::path& group) {
  double quota = 0.0;
  double period = 0.0;
  if (std::ifstream file(group / "cpu.max"); !(file >> quota >> period)) {
    quota = read_number(group / "cpu.cfs_quota_us").value_or(-1.0);
    period = read_number(group / "cpu.cfs_period_us").value_or(0.0);
  }
  return quota > 0.0 && period > 0.0 ? std::optional(quota / period) : std::nullopt;
}
std::optional<double> memory_of(const fs::path& group) {
  const auto out = read_number(group / "memory.max");
  return out ? out : read_number(group / "memory.limit_in_bytes");
}

// Where the groups of a line of /proc/self/cgroup, "NUMBER:CONTROLLERS:PATH", may be mounted.
std::vector<fs::path> mounts_of(const std::string& controllers, std::string_view wanted) {
  if (controllers.empty()) return {"sys/fs/cgroup", "sys/fs/cgroup/unified"};
  const std::vector<std::string> names = absl::StrSplit(controllers, ',');
  if (std::ranges::find(names, wanted) == names.end()) return {};
  return {fs::path("sys/fs/cgroup") / wanted, fs::path("sys/fs/cgroup") / controllers};
}

// The smallest limit of this process's groups and of all above them.
template <typename LimitOf>
std::optional<double> smallest_limit(const fs::path& root, std::string_view controller, const LimitOf& limit_of) {
  std::optional<double> out;
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> parts = absl::StrSplit(line, absl::MaxSplits(':', 2));
    if (parts.size() < 3) continue;
    for (const fs::path& mount : mounts_of(parts[1], controller)) {
      // In a container the path may be the host's, and only the mount itself is there.
      for (fs::path group = fs::path(parts[2]).relative_path();; group = group.parent_path()) {
        if (const auto limit = limit_of(root / mount / group)) out = std::min(out.value_or(*limit), *limit);
        if (group.empty()) break;
      }
    }
  }
  return out;
}

std::optional<int> affinity() {
  // Room for more processors than any kernel has.
  std::vector<cpu_set_t> set(8);
  const std::size_t size = set.size() * sizeof(cpu_set_t);
  if (sched_getaffinity(0, size, set.data()) != 0) return std::nullopt;
  return CPU_COUNT_S(size, set.data());
}

std::optional<int> cores_by_slurm() {
  const char* given = std::getenv("SLURM_CPUS_ON_NODE");
  int out = 0;
  return given != nullptr && absl::SimpleAtoi(given, &out) ? std::optional(out) : std::nullopt;
}

}  // namespace

std::string Cores::text() const {
  return fmt::format("{} {}{}", count, count == 1 ? "core" : "cores", limit.empty() ? "" : " (" + limit + ")");
}

Cores usable_cores(const fs::path& root) {
  Cores out{static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN))), ""};
  const auto limit = [&out](const std::optional<int>& count, const char* by) {
    if (count && *count < out.count) out = {std::max(1, *count), by};
  };
  limit(affinity(), "affinity");
  if (const auto quota = smallest_limit(root, "cpu", cores_of)) {
    limit(static_cast<int>(std::ceil(std::min(*quota, 1e6))), "cgroup quota");
  }
  limit(cores_by_slurm(), "Slurm");
  return out;
}

std::int64_t usable_memory(const fs::path& root) {
  const auto of_machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const auto limit = smallest_limit(root, "memory", memory_of);
  return std::llround(std::min(of_machine, limit.value_or(of_machine)));
}

}  // namespace cellcrush
