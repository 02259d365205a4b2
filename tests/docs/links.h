#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docs/page.h"

namespace cellcrush::docs {

/// What is wrong with a page, in a line: "path:line: what".
using Findings = std::vector<std::string>;

/// "path:line: ", what a finding begins with.
std::string place_of(const Page& page, int line);

/// Links of the pages to files, folders and headings that do not exist, links out of the tree, torn lines, and prose
/// wider than 120 columns. Addresses of the web are not looked up.
Findings check_links(const std::filesystem::path& root, const std::vector<Page>& pages);

/// A finding a line, for messages.
std::string to_text(const Findings& findings);

}  // namespace cellcrush::docs
