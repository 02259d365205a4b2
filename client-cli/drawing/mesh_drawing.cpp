#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "command_error.h"
#include "drawing/drawing.h"

// Lines of meshes: beams and trusses of an Abaqus input file, lines of a Gmsh file (ASCII, 2.2 and 4.1).
namespace cellcrush::client {
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
  std::vector<double> next_numbers() {
    std::string line;
    if (!next(line)) fail("the file ends too early.");
    return numbers(line);
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
    drawing.walls.push_back({nodes.at(from), nodes.at(to), 0.0, {}, std::move(name)});
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
      mesh.nodes[std::lround(numbers[0])] = {numbers[1], numbers[2]};
    } else if (is_line) {
      const auto numbers = lines.numbers(line);
      if (numbers.size() < 3) lines.fail("an element needs a number and two nodes.");
      const std::string name = fmt::format("element {}", std::lround(numbers[0]));
      mesh.add(std::lround(numbers[1]), std::lround(numbers.back()), name, lines, drawing);
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

Drawing read_gmsh_drawing(const std::string& text, const std::string& file) {
  constexpr int kLine = 1;
  constexpr int kLineOfThree = 8;
  Lines lines(text, file);
  Mesh mesh;
  Drawing drawing;
  bool is_new = false;  // version 4
  std::string line;
  while (lines.next(line)) {
    if (line.starts_with("$MeshFormat")) {
      const auto format = lines.next_numbers();
      if (format.size() < 2 || format[1] != 0.0) lines.fail("is binary. Save the mesh as ASCII.");
      is_new = format[0] >= 4.0;
    } else if (line.starts_with("$Nodes")) {
      const auto head = lines.next_numbers();
      if (!is_new) {
        for (long i = 0; i < std::lround(head.at(0)); ++i) {
          const auto node = lines.next_numbers();
          if (node.size() < 3) lines.fail("a node needs a number, x and y.");
          mesh.nodes[std::lround(node[0])] = {node[1], node[2]};
        }
        continue;
      }
      for (long block = 0; block < std::lround(head.at(0)); ++block) {
        const auto entity = lines.next_numbers();
        if (entity.size() < 4) lines.fail("a block of nodes needs four numbers.");
        std::vector<long> tags;
        for (long i = 0; i < std::lround(entity[3]); ++i) tags.push_back(std::lround(lines.next_numbers().at(0)));
        for (const long tag : tags) {
          const auto place = lines.next_numbers();
          if (place.size() < 2) lines.fail("a node needs x and y.");
          mesh.nodes[tag] = {place[0], place[1]};
        }
      }
    } else if (line.starts_with("$Elements")) {
      const auto head = lines.next_numbers();
      const auto add = [&](int type, const std::vector<double>& words, std::size_t first) {
        if (type != kLine && type != kLineOfThree) return;
        if (words.size() < first + 2) lines.fail("a line needs two nodes.");
        const std::string name = fmt::format("element {}", std::lround(words[0]));
        mesh.add(std::lround(words[first]), std::lround(words[first + 1]), name, lines, drawing);
      };
      for (long block = 0; block < std::lround(head.at(0)); ++block) {
        const auto words = lines.next_numbers();
        if (!is_new) {
          if (words.size() < 3) lines.fail("an element needs a number, a type and its tags.");
          add(static_cast<int>(words[1]), words, 3 + static_cast<std::size_t>(words[2]));
          continue;
        }
        if (words.size() < 4) lines.fail("a block of elements needs four numbers.");
        for (long i = 0; i < std::lround(words[3]); ++i) add(static_cast<int>(words[2]), lines.next_numbers(), 1);
      }
    }
  }
  return drawing;
}

}  // namespace cellcrush::client
