// How many words the pages have that someone wrote, and someone has to read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "docs/page.h"

namespace cellcrush::docs {
namespace {

/// Pages that programs write as a whole.
const std::set<std::string> kGenerated = {"CHANGELOG.md", "proto/api.md", "proto/fields.md",
                                          "client-cli/commands.md", "server/configuration.md"};

/// The text without what stands from one mark to the next other, both on lines of their own.
std::string without(const std::string& text, const std::string& begin, const std::string& end) {
  std::istringstream lines(text);
  std::string rest;
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!is_inside && line.starts_with(begin)) {
      is_inside = true;
    } else if (is_inside && line.starts_with(end)) {
      is_inside = false;
    } else if (!is_inside) {
      rest += line + "\n";
    }
  }
  return rest;
}

/// Words with a letter or a digit, outside code blocks, comments and tables that programs write.
int words_by_hand(const std::string& page) {
  static const std::regex kComment("<!--(?:[^-]|-[^-]|--[^>])*-->");
  const std::string text = without(without(page, "<!-- table: ", "<!-- end of table -->"), "```", "```");
  std::istringstream words(std::regex_replace(text, kComment, ""));
  int count = 0;
  for (std::string word; words >> word;) {
    count += std::ranges::any_of(word, [](unsigned char letter) { return std::isalnum(letter) != 0; }) ? 1 : 0;
  }
  return count;
}

TEST(Words, OfPagesByHandAreAtMost50000) {
  const std::filesystem::path root = CELLCRUSH_SOURCE_ROOT;
  int count = 0;
  for (const Page& page : read_pages(root)) {
    if (!kGenerated.contains(page.path)) count += words_by_hand(read_text(root / page.path));
  }
  RecordProperty("words", count);
  EXPECT_GT(count, 10000);
  EXPECT_LE(count, 50000) << "Say it shorter, or have a program write it.";
}

TEST(Words, AreCountedOutsideOfBlocksCommentsAndTablesOfPrograms) {
  EXPECT_EQ(words_by_hand("# One two\n\n| three | 4 |\n|---|---|\n```sh\nnot this\n```\n<!-- nor this -->five\n"
                          "<!-- table: t -->\n| nor | that |\n<!-- end of table -->\n"),
            5);
}

}  // namespace
}  // namespace cellcrush::docs
