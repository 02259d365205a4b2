#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::docs {

/// A link or an image of a page.
struct Link {
  int line = 0;        ///< from 1
  std::string target;  ///< as it stands between the parentheses
};

/// A fenced block, or the code between two backticks.
struct Code {
  int line = 0;          ///< of its first line, from 1
  std::string language;  ///< the word behind the fence; empty without one, and for code between backticks
  std::string text;      ///< a block's lines, each with its line feed
  std::string file;      ///< of a block: FILE of "save this as `FILE`" in the paragraph before it
  std::string excuse;    ///< of a block: REASON of `<!-- not run: REASON -->` before it
};

/// What the tests read of a Markdown page.
struct Page {
  std::string path;                  ///< from the root of the tree, with forward slashes
  std::vector<std::string> anchors;  ///< of its headings, as GitHub names them
  std::vector<Link> links;
  std::vector<Code> blocks;  ///< also COMMAND of `<!-- run: COMMAND -->`, in the language "run"
  std::vector<Code> inline_codes;
  std::vector<int> wide_lines;  ///< prose of more than 120 columns: neither code, table, link nor comment
  std::vector<int> torn_lines;  ///< headings without a space, rows of a table without their end: a formatter's work
};

/// The anchor of a heading as GitHub names it: small letters, hyphens for spaces, no punctuation.
std::string anchor_of(const std::string& heading);

/// All bytes of a file.
std::string read_text(const std::filesystem::path& file);

/// Reads Markdown text. Nothing in a fenced block or an HTML comment counts as a link, a heading or code.
Page parse_page(std::string path, const std::string& text);

/// All pages of the tree, sorted by path, without hidden folders, build/ and node_modules/.
/// Throws std::filesystem::filesystem_error when the tree cannot be read.
std::vector<Page> read_pages(const std::filesystem::path& root);

}  // namespace cellcrush::docs
