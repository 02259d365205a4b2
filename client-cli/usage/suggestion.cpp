#include "usage/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "usage/command_entries.h"

namespace cellcrush {

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

void append_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const OptionEntry& option : option_entries(app)) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
}

std::string message_of(const CLI::App& app, const CLI::App* command, const CLI::Error& error) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) {
    return command == nullptr && app.get_require_subcommand_min() > 0 ? "no command given" : error.what();
  }
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  if (word.starts_with('-')) {
    std::vector<std::string> names;
    if (command != nullptr) append_option_names(*command, names);
    append_option_names(app, names);
    return with_suggestion(fmt::format("unknown option \"{}\"", word), find_nearest(word, names));
  }
  if (command != nullptr) return fmt::format("unexpected argument \"{}\"", unknown.front());
  return with_suggestion(fmt::format("unknown command \"{}\"", word), find_nearest(word, command_names(app)));
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

std::string with_suggestion(std::string message, const std::string& nearest) {
  if (nearest.empty()) return message;
  message += message.ends_with('.') ? " Did" : "; did";
  return message + fmt::format(" you mean \"{}\"?", nearest);
}

std::string usage_message(const CLI::App& app, const CLI::Error& error) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  const CLI::App* command = given.empty() ? nullptr : given.front();
  const std::string words = command == nullptr ? app.get_name() : app.get_name() + " " + command->get_name();
  return fmt::format("{}\nSee `{} --help`.", message_of(app, command, error), words);
}

}  // namespace cellcrush
