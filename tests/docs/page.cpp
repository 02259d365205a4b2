#include "docs/page.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <utility>

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kColumns = 120;

// GitHub puts a number behind the second heading of a name.
std::string next_anchor(const std::string& heading, std::map<std::string, int>& seen) {
  const std::string anchor = anchor_of(heading);
  const int before = seen[anchor]++;
  return before == 0 ? anchor : anchor + "-" + std::to_string(before);
}

// Takes the code between backticks out of a line, so that nothing in it is read as a link.
std::string without_code(const std::string& line, int number, std::vector<Code>& codes) {
  static const std::regex kCode("(`+)(.*?[^`])\\1(?!`)");
  std::string rest;
  auto begin = line.cbegin();
  for (std::smatch match; std::regex_search(begin, line.cend(), match, kCode); begin = match.suffix().first) {
    codes.push_back({number, "", match[2].str(), "", ""});
    rest += match.prefix().str() + "`";
  }
  return rest.append(begin, line.cend());
}

void read_links(const std::string& line, int number, std::vector<Link>& links) {
  static const std::regex kLink(R"(\]\(<?([^)\s>]+)>?(?:\s+"[^"]*")?\))");
  for (auto match = std::sregex_iterator(line.begin(), line.end(), kLink); match != std::sregex_iterator(); ++match) {
    links.push_back({number, (*match)[1].str()});
  }
}

std::size_t columns_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](char letter) { return (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U; }));
}

bool may_be_wide(const std::string& line) {
  return line.starts_with("|") || line.find("](") != std::string::npos || line.starts_with("<");
}

// What a formatter of code makes of Markdown.
bool is_torn(const std::string& line) {
  static const std::regex kHeadingWithoutSpace("#{1,6}[^#\\s].*");
  static const std::regex kRowWithoutEnd("\\|.*[^|\\s]\\s*");
  return std::regex_match(line, kHeadingWithoutSpace) || std::regex_match(line, kRowWithoutEnd);
}

// The part of a line outside HTML comments.
std::string without_comments(std::string line, bool& in_comment) {
  std::string rest;
  while (!line.empty()) {
    const std::size_t edge = line.find(in_comment ? "-->" : "<!--");
    if (!in_comment) rest += line.substr(0, edge);
    if (edge == std::string::npos) break;
    line.erase(0, edge + (in_comment ? 3 : 4));
    in_comment = !in_comment;
  }
  return rest;
}

// What stands before a block: the last paragraph, and the comments for the tests.
class LeadIn {
 public:
  // Commands for the tests become blocks.
  void read(const std::string& line, int number, std::vector<Code>& blocks) {
    static const std::regex kComment(" *<!-- (not run|run): (.*) -->");
    std::smatch match;
    if (std::regex_match(line, match, kComment)) {
      if (match[1] == "run") {
        blocks.push_back({number, "run", match[2].str() + "\n", "", ""});
      } else {
        excuse_ = match[2];
      }
    } else if (line.empty()) {
      ended_ = true;
    } else {
      if (ended_) *this = {};
      text_ += line + " ";
    }
  }

  Code open_block(int number, const std::string& language) {
    static const std::regex kFile("[Ss]ave [^.`]*as `([^`]+)`");
    Code block{number, language, "", "", excuse_};
    if (std::smatch match; std::regex_search(text_, match, kFile)) block.file = match[1];
    *this = {};
    return block;
  }

 private:
  std::string text_;
  std::string excuse_;
  bool ended_ = false;
};

}  // namespace

std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == ' ') {
      anchor += '-';
    } else if (byte >= 0x80 || std::isalnum(byte) != 0 || letter == '-' || letter == '_') {
      anchor += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    }
  }
  return anchor;
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Page parse_page(std::string path, const std::string& text) {
  static const std::regex kFence(R"(^(\s*)(```+|~~~+)\s*([A-Za-z0-9_+-]*).*$)");
  static const std::regex kHeading(R"(^#{1,6}\s+(.*?)\s*#*$)");
  Page page;
  page.path = std::move(path);
  std::map<std::string, int> seen;
  std::istringstream lines(text);
  std::string line;
  std::string fence;
  std::size_t indent = 0;  // of the fence
  bool in_comment = false;
  LeadIn lead_in;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (!fence.empty()) {
      if (std::regex_match(line, match, kFence) && match[2].str().starts_with(fence) && match[3].length() == 0) {
        fence.clear();
      } else {
        page.blocks.back().text += line.substr(std::min({indent, line.size(), line.find_first_not_of(' ')})) + "\n";
      }
      continue;
    }
    if (std::regex_match(line, match, kFence)) {
      indent = match[1].length();
      fence = match[2].str();
      page.blocks.push_back(lead_in.open_block(number + 1, match[3].str()));
      continue;
    }
    lead_in.read(line, number, page.blocks);
    line = without_comments(line, in_comment);
    if (columns_of(line) > kColumns && !may_be_wide(line)) page.wide_lines.push_back(number);
    if (is_torn(line)) page.torn_lines.push_back(number);
    read_links(without_code(line, number, page.inline_codes), number, page.links);
    if (std::regex_match(line, match, kHeading)) page.anchors.push_back(next_anchor(match[1].str(), seen));
  }
  return page;
}

std::vector<Page> read_pages(const fs::path& root) {
  std::vector<Page> pages;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name.starts_with(".") || name == "build" || name == "node_modules")) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && entry->path().extension() == ".md") {
      pages.push_back(parse_page(entry->path().lexically_relative(root).generic_string(), read_text(entry->path())));
    }
  }
  std::ranges::sort(pages, {}, &Page::path);
  return pages;
}

}  // namespace cellcrush::docs
