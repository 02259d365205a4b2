#include "slurm/process_tree.h"

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace cellcrush::testing {
namespace {

namespace fs = std::filesystem;

// 0 when the process is gone. Its name, in parentheses, may contain anything; state and parent follow.
pid_t parent_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(file, line);
  const auto end = line.rfind(')');
  if (end == std::string::npos || end + 4 > line.size()) return 0;
  return std::stoi(line.substr(end + 4));
}

std::multimap<pid_t, pid_t> all_by_parent() {
  std::multimap<pid_t, pid_t> processes;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (std::isdigit(static_cast<unsigned char>(name.front())) == 0) continue;
    const pid_t process = std::stoi(name);
    processes.emplace(parent_of(process), process);
  }
  return processes;
}

}  // namespace

std::vector<pid_t> children_of(pid_t process) {
  const auto processes = all_by_parent();
  std::vector<pid_t> children;
  const auto [first, last] = processes.equal_range(process);
  for (auto it = first; it != last; ++it) children.push_back(it->second);
  return children;
}

std::vector<pid_t> descendants_of(pid_t process) {
  const auto processes = all_by_parent();
  std::vector<pid_t> found{process};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [first, last] = processes.equal_range(found[i]);
    for (auto it = first; it != last; ++it) found.push_back(it->second);
  }
  found.erase(found.begin());
  return found;
}

std::string program_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

}  // namespace cellcrush::testing
