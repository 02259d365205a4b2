#include "house/source_lines.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

namespace cellcrush::house {

namespace {

// Takes blanks and then `word` from the front of `text`; false when something else stands there.
bool take(std::string_view& text, std::string_view word) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

}  // namespace

std::vector<IncludeLine> read_includes(const std::filesystem::path& file) {
  std::vector<IncludeLine> includes;
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::string_view rest = line;
    if (!take(rest, "#") || !take(rest, "include") || !(take(rest, "<") || take(rest, "\""))) continue;
    includes.push_back({number, std::string(rest.substr(0, rest.find_first_of(">\"")))});
  }
  return includes;
}

std::string resolve_include(const std::filesystem::path& root, const std::string& file, const std::string& target) {
  const std::filesystem::path path(file);
  const std::string folder = path.begin()->string();
  std::vector<std::string> places{path.parent_path().generic_string(), folder + "/include", folder};
  for (const char* place : {"core/include", "core", "server", "client-cli", "tests", "proto"})
    places.emplace_back(place);
  places.emplace_back("");
  const std::filesystem::path whole_root = std::filesystem::weakly_canonical(root);
  for (const std::string& place : places) {
    const std::filesystem::path candidate = std::filesystem::weakly_canonical(whole_root / place / target);
    const std::filesystem::path relative = candidate.lexically_relative(whole_root);
    const bool inside = !relative.empty() && *relative.begin() != "..";
    if (inside && std::filesystem::is_regular_file(candidate)) return relative.generic_string();
  }
  return "";
}

bool is_standard_header(const std::string& target) {
  static constexpr std::string_view kHeaders =
      " algorithm any array atomic barrier bit bitset cassert cctype cerrno cfenv cfloat charconv chrono cinttypes"
      " climits clocale cmath codecvt compare complex concepts condition_variable coroutine csetjmp csignal cstdarg"
      " cstddef cstdint cstdio cstdlib cstring ctime cuchar cwchar cwctype deque exception execution filesystem"
      " format forward_list fstream functional future initializer_list iomanip ios iosfwd iostream istream iterator"
      " latch limits list locale map memory memory_resource mutex new numbers numeric optional ostream queue random"
      " ranges ratio regex scoped_allocator semaphore set shared_mutex source_location span sstream stack stdexcept"
      " stop_token streambuf string string_view strstream syncstream system_error thread tuple type_traits typeindex"
      " typeinfo unordered_map unordered_set utility valarray variant vector version ";
  return target.find(' ') == std::string::npos && kHeaders.find(" " + target + " ") != std::string_view::npos;
}

bool has_bounded_lines(const std::filesystem::path& file) {
  static const std::set<std::string> kExtensions{".h", ".hpp", ".inl", ".cpp", ".cc", ".proto", ".cmake", ".sh", ".py"};
  const bool is_script = *file.begin() == "deploy" && !file.has_extension();
  // Beside it lie folders that the page's build fills.
  const bool is_of_page = file.extension() == ".ts" && file.generic_string().starts_with("server/page/src/");
  return is_script || is_of_page || file.filename() == "CMakeLists.txt" ||
         kExtensions.contains(file.extension().string());
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
