#pragma once

#include <filesystem>
#include <string>

namespace cellcrush::docs {

/// `cmake --install` of the build that the test belongs to.
void install(const std::filesystem::path& prefix);

/// Types the console blocks of a page of the tree, after an installation, in a folder of their own, which has the tree
/// as `cellcrush`, and expects of each command what the page shows.
void expect_shown(const std::string& path);

}  // namespace cellcrush::docs
