#include "house/wide_lines.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

namespace cellcrush::house {
namespace {

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

}  // namespace

bool has_bounded_lines(const std::filesystem::path& file) {
  static const std::set<std::string> kExtensions{".h", ".hpp", ".inl", ".cpp", ".cc", ".proto", ".cmake", ".sh", ".py"};
  const bool is_script = *file.begin() == "deploy" && !file.has_extension();
  return is_script || file.filename() == "CMakeLists.txt" || kExtensions.contains(file.extension().string());
}

std::vector<int> find_wide_lines(const std::filesystem::path& file) {
  std::vector<int> wide;
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const auto columns = static_cast<std::size_t>(std::count_if(line.begin(), line.end(), begins_character));
    if (columns > kMostColumns) wide.push_back(number);
  }
  return wide;
}

}  // namespace cellcrush::house
