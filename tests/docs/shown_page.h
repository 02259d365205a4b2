#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "docs/session.h"

namespace cellcrush::docs {

/// `cmake --install` of the build that the test belongs to.
void install(const std::filesystem::path& prefix);

/// Types the console blocks of a page of the tree, after an installation in ~/.local, in a home of their own, which has
/// the tree as ~/cellcrush, and expects of each command what the page shows. `instead` has words of the page, and what
/// is typed instead of each; `saved` has files that the reader saves first, each with the language of the page's block
/// that stands in it.
void expect_shown(const std::string& path, Reader reader = Reader::caller,
                  const std::map<std::string, std::string>& instead = {},
                  const std::map<std::string, std::string>& saved = {});

}  // namespace cellcrush::docs
