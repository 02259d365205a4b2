#pragma once

#include <cstddef>
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

/// Columns of a line of source, its comment included.
inline constexpr std::size_t kMostColumns = 120;

/// Whether a file, as a path from the root, is held to kMostColumns: C++, protocol buffers, CMake, shell and Python.
bool has_bounded_lines(const std::filesystem::path& file);

/// Numbers of the lines that are wider. A character of UTF-8 is a column.
std::vector<int> find_wide_lines(const std::filesystem::path& file);

}  // namespace cellcrush::house
