#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "drawing/drawing.h"

// Lines of meshes: beams and trusses of an Abaqus input file, lines of a Gmsh file (ASCII, 2.2 and 4.1).
namespace cellcrush::drawing {
namespace {

/// Lines of a file, with their numbers.
class Lines {
 public:
  Lines(const std::string& text, std::string file) : stream_(text), file_(std::move(file)) {}

  bool next(std::string& line) {
    ++number_;
    if (!std::getline(stream_, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  }
  [[noreturn]] void fail(const std::string& what) const { refuse(fmt::format("{}:{}: {}", file_, number_, what)); }

  /// The numbers of a line, parted by blanks or commas.
  [[nodiscard]] std::vector<double> numbers(const std::string& line) const {
    std::string blanks = line;
    std::ranges::replace(blanks, ',', ' ');
    std::istringstream words(blanks);
    std::vector<double> numbers;
    for (std::string word; words >> word;) {
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) fail(fmt::format("\"{}\" is no number.", word));
      numbers.push_back(value);
    }
    return numbers;
  }
  std::vector<double> next_numbers(std::size_t least, const char* what) {
    std::string line;
    if (!next(line)) fail("the file ends too early.");
    std::vector<double> values = numbers(line);
    if (values.size() < least) fail(what);
    return values;
  }
  /// A number as an index or a count.
  [[nodiscard]] long whole(double value) const {
    constexpr double kLargest = 1e15;
    if (!(std::abs(value) <= kLargest)) fail(fmt::format("{} is no whole number.", value));
    return std::lround(value);
  }

 private:
  std::istringstream stream_;
  std::string file_;
  int number_ = 0;
};

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char letter) { return std::toupper(letter); });
  return text;
}

/// Walls between numbered nodes.
struct Mesh {
  std::map<long, DrawnPlace> nodes;

  void add(long from, long to, std::string name, const Lines& lines, Drawing& drawing) const {
    if (!nodes.contains(from) || !nodes.contains(to)) lines.fail("names a node that the file has not.");
    drawing.add({nodes.at(from), nodes.at(to), 0.0, {}, std::move(name)});
  }
};

/// The value of NAME=VALUE in the words of a keyword, in capitals; empty without it.
std::string option_of(const std::string& keyword, const std::string& name) {
  std::istringstream words(upper(keyword));
  for (std::string word; std::getline(words, word, ',');) {
    std::erase(word, ' ');
    if (word.starts_with(name + "=")) return word.substr(name.size() + 1);
  }
  return "";
}

bool is_line_element(const std::string& type) {
  return type.starts_with("B2") || type.starts_with("B3") || type.starts_with("T2") || type.starts_with("T3");
}

/// Reads the lines of a Gmsh file.
class GmshReader {
 public:
  GmshReader(const std::string& text, const std::string& file) : lines_(text, file) {}

  Drawing read() {
    std::string line;
    while (lines_.next(line)) {
      if (line.starts_with("$MeshFormat")) {
        const auto format = lines_.next_numbers(2, "a format needs a version and a type.");
        if (format[1] != 0.0) lines_.fail("is binary. Save the mesh as ASCII.");
        is_new_ = format[0] >= 4.0;
      } else if (line.starts_with("$Nodes")) {
        read_nodes();
      } else if (line.starts_with("$Elements")) {
        read_elements();
      }
    }
    return std::move(drawing_);
  }

 private:
  long read_count() { return lines_.whole(lines_.next_numbers(1, "a number of entries is missing.")[0]); }

  void read_nodes() {
    const long count = read_count();
    for (long i = 0; i < count; ++i) is_new_ ? read_block_of_nodes() : read_node();
  }

  void read_node() {
    const auto node = lines_.next_numbers(3, "a node needs a number, x and y.");
    mesh_.nodes[lines_.whole(node[0])] = {node[1], node[2]};
  }

  void read_block_of_nodes() {
    const long count = lines_.whole(lines_.next_numbers(4, "a block of nodes needs four numbers.")[3]);
    std::vector<long> tags;
    for (long i = 0; i < count; ++i) tags.push_back(lines_.whole(lines_.next_numbers(1, "a node needs a number.")[0]));
    for (const long tag : tags) {
      const auto place = lines_.next_numbers(2, "a node needs x and y.");
      mesh_.nodes[tag] = {place[0], place[1]};
    }
  }

  void read_elements() {
    const long count = read_count();
    for (long i = 0; i < count; ++i) is_new_ ? read_block_of_elements() : read_element();
  }

  void read_element() {
    const auto words = lines_.next_numbers(3, "an element needs a number, a type and its tags.");
    add(lines_.whole(words[1]), words, 3 + lines_.whole(words[2]));
  }

  void read_block_of_elements() {
    const auto block = lines_.next_numbers(4, "a block of elements needs four numbers.");
    const long count = lines_.whole(block[3]);
    for (long i = 0; i < count; ++i) {
      add(lines_.whole(block[2]), lines_.next_numbers(1, "an element needs a number."), 1);
    }
  }

  /// A line whose nodes begin at a word.
  void add(long type, const std::vector<double>& words, long first) {
    constexpr long kLine = 1;
    constexpr long kLineOfThree = 8;
    if (type != kLine && type != kLineOfThree) return;
    if (first < 0 || first + 2 > static_cast<long>(words.size())) lines_.fail("a line needs two nodes.");
    const std::string name = fmt::format("element {}", lines_.whole(words[0]));
    mesh_.add(lines_.whole(words[first]), lines_.whole(words[first + 1]), name, lines_, drawing_);
  }

  Lines lines_;
  Mesh mesh_;
  Drawing drawing_;
  bool is_new_ = false;  ///< version 4
};

}  // namespace

Drawing read_abaqus_drawing(const std::string& text, const std::string& file) {
  Lines lines(text, file);
  Mesh mesh;
  Drawing drawing;
  std::map<std::string, double> thickness_of_set;
  std::vector<std::string> sets;  // of each wall
  std::string line;
  std::string section;
  std::string set;
  bool is_line = false;
  while (lines.next(line)) {
    if (line.starts_with("**") || line.find_first_not_of(" \t") == std::string::npos) continue;
    if (line.front() == '*') {
      section = upper(line.substr(0, line.find(',')));
      set = option_of(line, "ELSET");
      is_line = section == "*ELEMENT" && is_line_element(option_of(line, "TYPE"));
      if (section == "*BEAM SECTION" && option_of(line, "SECTION") != "RECT") section.clear();
    } else if (section == "*NODE") {
      const auto numbers = lines.numbers(line);
      if (numbers.size() < 3) lines.fail("a node needs a number, x and y.");
      mesh.nodes[lines.whole(numbers[0])] = {numbers[1], numbers[2]};
    } else if (is_line) {
      const auto numbers = lines.numbers(line);
      if (numbers.size() < 3) lines.fail("an element needs a number and two nodes.");
      const std::string name = fmt::format("element {}", lines.whole(numbers[0]));
      mesh.add(lines.whole(numbers[1]), lines.whole(numbers.back()), name, lines, drawing);
      sets.push_back(set);
    } else if (section == "*BEAM SECTION") {
      const auto numbers = lines.numbers(line);
      if (numbers.size() >= 2) thickness_of_set[set] = numbers[1];  // the second side lies in the plane
      section.clear();
    }
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto found = thickness_of_set.find(sets[i]);
    if (found != thickness_of_set.end()) drawing.walls[i].thickness = found->second;
  }
  return drawing;
}

Drawing read_gmsh_drawing(const std::string& text, const std::string& file) { return GmshReader(text, file).read(); }

}  // namespace cellcrush::drawing
