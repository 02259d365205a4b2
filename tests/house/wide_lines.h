#pragma once

#include <filesystem>
#include <vector>

namespace cellcrush::house {

/// Columns of a line of source, its comment included.
inline constexpr std::size_t kMostColumns = 120;

/// Whether a file, as a path from the root, is held to kMostColumns: C++, protocol buffers, CMake, shell and Python.
bool has_bounded_lines(const std::filesystem::path& file);

/// Numbers of the lines that are wider. A character of UTF-8 is a column.
std::vector<int> find_wide_lines(const std::filesystem::path& file);

}  // namespace cellcrush::house
