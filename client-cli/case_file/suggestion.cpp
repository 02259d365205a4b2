#include "case_file/suggestion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace cellcrush::client {

namespace {

char lower(char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); }

// Edit distance with transpositions (optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string find_nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t kLongestWord = 100;
  if (word.size() > kLongestWord) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    // A name without its unit, such as "speed" for "speed_m_per_s", counts as near.
    const bool prefix = word.size() >= 3 && candidate.compare(0, word.size(), word) == 0;
    const std::size_t edits = prefix ? 1 : distance(word, candidate);
    if (edits < least) {
      least = edits;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string find_nearest_file(const std::string& missing) {
  namespace fs = std::filesystem;
  const fs::path path(missing);
  const fs::path folder = path.parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (!entry->is_directory(error) && name != path.filename()) names.push_back(name.string());
  }
  std::sort(names.begin(), names.end());
  const std::string nearest = find_nearest(path.filename().string(), names);
  return nearest.empty() ? nearest : (folder / nearest).string();
}

std::string open_failure(const std::string& file, std::ifstream& stream) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) return file + ": is a folder";
  stream.open(file, std::ios::binary);
  if (stream) return {};
  const int error = errno;
  const std::string message = fmt::format("{}: cannot be read: {}", file, std::strerror(error));
  return error == ENOENT ? with_suggestion(message, find_nearest_file(file)) : message;
}

std::string with_suggestion(std::string message, const std::string& nearest) {
  if (nearest.empty()) return message;
  message += message.ends_with('.') ? " Did" : "; did";
  return message + fmt::format(" you mean \"{}\"?", nearest);
}

std::vector<std::string> field_names(const google::protobuf::Descriptor& type) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(type.field_count()));
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

std::string unknown_field_message(std::string_view field, const google::protobuf::Descriptor& type) {
  const std::vector<std::string> names = field_names(type);
  const std::string nearest = find_nearest(field, names);
  const std::string message = fmt::format("{} has no field \"{}\"", type.name(), field);
  return nearest.empty() ? fmt::format("{}; it has: {}", message, fmt::join(names, ", "))
                         : with_suggestion(message, nearest);
}

std::string unknown_enum_message(std::string_view value, const google::protobuf::EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) names.push_back(type.value(i)->name());
  }
  return fmt::format("\"{}\" is not one of {}", value, fmt::join(names, ", "));
}

}  // namespace cellcrush::client
