#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::house {

/// One #include of a file.
struct IncludeLine {
  int line = 0;        ///< from 1
  std::string target;  ///< what stands between the quotes or brackets
};

/// The includes of a file in their order, also those that a condition or a block comment surrounds.
std::vector<IncludeLine> read_includes(const std::filesystem::path& file);

/// The header of the tree that `target` means in a file of the tree, as a path from the root; empty when it is none of
/// the tree's (a package's, or a generated one). Looks beside the file, then where the compiler looks for each folder,
/// the file's own folder first. `file` is a path from the root.
std::string resolve_include(const std::filesystem::path& root, const std::string& file, const std::string& target);

/// Whether it is a header of the C++ library.
bool is_standard_header(const std::string& target);

}  // namespace cellcrush::house
