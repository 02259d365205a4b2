#include "jobs/oom_kills.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace cellcrush::jobs {
namespace {

// The value of "oom_kill" in a file with one name and number per line.
std::optional<std::uint64_t> read_count(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string name;
  for (std::uint64_t count = 0; file >> name >> count;) {
    if (name == "oom_kill") return count;
  }
  return std::nullopt;
}

// For version 2 control groups the line is "0::/path".
std::filesystem::path control_group() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("0::")) return "/sys/fs/cgroup" + line.substr(3);
  }
  return {};
}

}  // namespace

std::uint64_t count_oom_kills() {
  const auto group = control_group();
  if (const auto count = group.empty() ? std::nullopt : read_count(group / "memory.events")) return *count;
  return read_count("/proc/vmstat").value_or(0);
}

}  // namespace cellcrush::jobs
