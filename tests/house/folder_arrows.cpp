#include "house/folder_arrows.h"

#include <algorithm>
#include <deque>
#include <string_view>

namespace cellcrush::house {
namespace {

// "core/step" of "core/step/loads.h"; empty for what is in no folder of core or server, and for core's public headers,
// which have a rule of their own.
std::string folder_of(const std::string& path) {
  const std::size_t room = path.find('/');
  const std::size_t end = room == std::string::npos ? room : path.find('/', room + 1);
  if (end == std::string::npos || !(path.starts_with("core/") || path.starts_with("server/"))) return "";
  const std::string folder = path.substr(0, end);
  return folder == "core/include" ? "" : folder;
}

std::string room_of(const std::string& folder) { return folder.substr(0, folder.find('/')); }

}  // namespace

void FolderArrows::add(const std::string& file, int line, const std::string& included) {
  const std::string from = folder_of(file);
  const std::string to = folder_of(included);
  if (from.empty() || to.empty() || from == to || room_of(from) != room_of(to)) return;
  arrows_[from][to].emplace(file, line);
}

std::vector<Violation> FolderArrows::find_cycles() const {
  std::vector<Violation> violations;
  std::set<std::string> named;
  for (const auto& [folder, targets] : arrows_) {
    const std::vector<std::string> way = way_round(folder);
    if (way.empty() || named.contains(folder)) continue;
    std::string rule = "No two folders of " + room_of(folder) + " include each other, but these do: " + folder;
    std::string lines;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      rule += " -> " + way[i + 1];
      for (const auto& [file, line] : arrows_.at(way[i]).at(way[i + 1]))
        lines += "\n  " + file + ":" + std::to_string(line);
    }
    named.insert(way.begin(), way.end());
    const auto& [file, line] = *arrows_.at(way[0]).at(way[1]).begin();
    violations.push_back({file, line, rule + ", by" + lines});
  }
  return violations;
}

std::vector<std::string> FolderArrows::way_round(const std::string& folder) const {
  std::map<std::string, std::string> before;  // of each folder that was reached
  std::deque<std::string> next = {folder};
  while (!next.empty() && !before.contains(folder)) {
    const auto from = arrows_.find(next.front());
    if (from != arrows_.end()) {
      for (const auto& [to, lines] : from->second) {
        if (before.emplace(to, next.front()).second) next.push_back(to);
      }
    }
    next.pop_front();
  }
  if (!before.contains(folder)) return {};
  std::vector<std::string> way = {folder};
  do {
    way.push_back(before.at(way.back()));
  } while (way.back() != folder);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace cellcrush::house
