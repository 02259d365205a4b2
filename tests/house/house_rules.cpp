#include "house/house_rules.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "house/source_lines.h"

namespace cellcrush::house {
namespace {

namespace fs = std::filesystem;

/// Which folders of core and of server include which others of the same room. Files that stand in no folder, and the
/// public headers of core, do not count.
class FolderArrows {
 public:
  /// Notes that a file includes another, both as paths from the root.
  void add(const std::string& file, int line, const std::string& included);

  /// Violations that together name every folder on a way round. Each names the folders of a shortest one and its
  /// include lines, and stands at the first of them.
  [[nodiscard]] std::vector<Violation> find_cycles() const;

 private:
  using Lines = std::set<std::pair<std::string, int>>;  ///< files and lines of one arrow

  /// The folders on a shortest way from a folder back to itself, which is both its first and last; empty when there is
  /// none.
  [[nodiscard]] std::vector<std::string> way_round(const std::string& folder) const;

  std::map<std::string, std::map<std::string, Lines>> arrows_;  ///< from folder to folder, "core/step"
};

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
    violations.push_back({file, line, rule.append(", by").append(lines)});
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

// The entries of the project, then what tools leave at the root.
constexpr std::string_view kRootEntries =
    " CMakeLists.txt CMakePresets.json README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE .ci .clang-format "
    ".clang-tidy "
    ".gitignore"
    " client-cli core deploy proto server tests"
    " .git build .cache .idea .vscode compile_commands.json CMakeUserPresets.json ";

bool is_agreed(const std::string& name) { return kRootEntries.find(" " + name + " ") != std::string_view::npos; }

bool is_within(const std::string& path, const std::string& folder) { return path.starts_with(folder + "/"); }

bool is_message_header(const std::string& target) { return target.ends_with(".pb.h"); }

bool is_clock_or_file(const std::string& target) {
  static const std::set<std::string> kHeaders{"chrono", "ctime", "filesystem", "fstream"};
  return kHeaders.contains(target);
}

// The rules for one include of one file; `resolved` is empty when the header is none of the tree's.
std::string broken_rule(const std::string& file, const std::string& target, const std::string& resolved) {
  if (!is_within(file, "tests") && is_within(resolved, "tests")) return "nobody but tests includes tests";
  if (is_within(file, "tests/core/reference") && is_within(resolved, "core"))
    return "the oracle shares nothing with core";
  if (is_within(file, "core")) {
    if (is_clock_or_file(target)) return "core knows no clock and no files";
    const bool inner = !is_within(file, "core/include");
    const bool is_cache_size = file == "core/parallel/workers.cpp" && target == "unistd.h";
    if (file == "core/law/fibre_law-inl.h" && target == "law/kinds-inl.h") return "";  // CMake writes it
    const bool package =
        resolved.empty() &&
        (is_standard_header(target) || target.starts_with("Eigen/") || (inner && target.starts_with("hwy/")) ||
         is_cache_size || (file.starts_with("core/lattice/") && target == "boost/polygon/voronoi.hpp"));
    if (!package && !is_within(resolved, "core")) return "core includes nothing outside core";
    if (!package && is_within(file, "core/include") && !is_within(resolved, "core/include"))
      return "core/include takes only headers of core/include";
  }
  if (is_within(file, "server") && is_within(resolved, "core") && !is_within(resolved, "core/include"))
    return "server includes no header of core but those in core/include";
  if (is_within(file, "server") && is_within(resolved, "client-cli") && !is_within(resolved, "client-cli/usage") &&
      !is_within(resolved, "client-cli/drawing"))
    return "server includes no header of client-cli but those in client-cli/drawing and client-cli/usage";
  if (is_within(file, "proto") && !resolved.empty() && !is_within(resolved, "proto"))
    return "proto includes nothing outside proto";
  if (is_within(file, "client-cli") && (is_within(resolved, "core") || is_within(resolved, "server")))
    return "client-cli includes no header of core or server";
  return "";
}

void check_file(const fs::path& root, const std::string& file, FolderArrows& arrows,
                std::vector<Violation>& violations) {
  const std::vector<IncludeLine> includes = read_includes(root / file);
  const bool has_message = std::any_of(includes.begin(), includes.end(),
                                       [](const auto& include) { return is_message_header(include.target); });
  for (const IncludeLine& include : includes) {
    const std::string resolved = resolve_include(root, file, include.target);
    arrows.add(file, include.line, resolved);
    std::string rule = broken_rule(file, include.target, resolved);
    if (rule.empty() && has_message && is_within(file, "server") && !is_within(file, "server/translate") &&
        is_within(resolved, "core"))
      rule = "only server/translate joins messages and core's headers";
    if (!rule.empty()) violations.push_back({file, include.line, rule + ", but this includes " + include.target + "."});
  }
}

void check_width(const fs::path& root, const std::string& file, std::vector<Violation>& violations) {
  if (!has_bounded_lines(file)) return;
  for (const int line : find_wide_lines(root / file)) {
    violations.push_back({file, line, "Lines end within " + std::to_string(kMostColumns) + " columns."});
  }
}

bool is_source(const fs::path& path) {
  static const std::set<std::string> kExtensions{".h", ".hpp", ".inl", ".cpp", ".cc"};
  return kExtensions.contains(path.extension().string());
}

}  // namespace

std::vector<Violation> check_house(const fs::path& root) {
  std::vector<Violation> violations;
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (!is_agreed(name)) violations.push_back({name, 0, "The root of the tree holds agreed entries only."});
  }
  FolderArrows arrows;
  check_width(root, "CMakeLists.txt", violations);
  for (const char* folder : {"core", "server", "client-cli", "proto", "tests", "deploy"}) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      check_width(root, file, violations);
      if (is_source(entry.path())) check_file(root, file, arrows, violations);
    }
  }
  for (Violation& cycle : arrows.find_cycles()) violations.push_back(std::move(cycle));
  std::sort(violations.begin(), violations.end(),
            [](const Violation& a, const Violation& b) { return std::tie(a.file, a.line) < std::tie(b.file, b.line); });
  return violations;
}

std::string to_text(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations)
    text += violation.file + ":" + std::to_string(violation.line) + ": " + violation.rule + "\n";
  return text;
}

}  // namespace cellcrush::house
