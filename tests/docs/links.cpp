#include "docs/links.h"

#include <algorithm>

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

bool is_web_address(const std::string& target) {
  return target.starts_with("https://") || target.starts_with("http://") || target.starts_with("mailto:");
}

const Page* find_page(const std::vector<Page>& pages, const std::string& path) {
  const auto found = std::ranges::find(pages, path, &Page::path);
  return found == pages.end() ? nullptr : &*found;
}

// What is wrong with a link; empty when it holds.
std::string fault_of(const fs::path& root, const std::vector<Page>& pages, const Page& page, const Link& link) {
  const std::size_t hash = link.target.find('#');
  const std::string file = link.target.substr(0, hash);
  const std::string anchor = hash == std::string::npos ? "" : link.target.substr(hash + 1);
  const fs::path path =
      file.empty() ? fs::path(page.path) : (fs::path(page.path).parent_path() / file).lexically_normal();
  if (path.is_absolute() || path.generic_string().starts_with("..")) return "leaves the tree";
  if (!file.empty() && !fs::exists(root / path)) return "no such file";
  if (anchor.empty()) return "";
  const Page* target = find_page(pages, path.generic_string());
  if (target == nullptr) return "an anchor in a file that is not a page";
  return std::ranges::find(target->anchors, anchor) == target->anchors.end() ? "no such heading" : "";
}

}  // namespace

std::string place_of(const Page& page, int line) { return page.path + ":" + std::to_string(line) + ": "; }

Findings check_links(const fs::path& root, const std::vector<Page>& pages) {
  Findings findings;
  for (const Page& page : pages) {
    for (const Link& link : page.links) {
      if (is_web_address(link.target)) continue;
      const std::string fault = fault_of(root, pages, page, link);
      if (!fault.empty()) {
        findings.push_back(place_of(page, link.line) + link.target + ": " + fault);
      }
    }
    for (const int line : page.wide_lines) {
      findings.push_back(place_of(page, line) + "more than 120 columns");
    }
    for (const int line : page.torn_lines) {
      findings.push_back(place_of(page, line) + "a heading without a space, or a row of a table without its end");
    }
  }
  return findings;
}

std::string to_text(const Findings& findings) {
  std::string text;
  for (const std::string& finding : findings) text += finding + "\n";
  return text;
}

}  // namespace cellcrush::docs
