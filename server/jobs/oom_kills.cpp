#include "jobs/oom_kills.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace cellcrush::jobs {
namespace {

// The number behind "oom_kill", in a file of a name and a number a line.
std::optional<std::uint64_t> read_count(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string name;
  for (std::uint64_t count = 0; file >> name >> count;) {
    if (name == "oom_kill") return count;
  }
  return std::nullopt;
}

// Of control groups of version 2 the line is "0::/path".
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
