#include "docs/shown_output.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <regex>
#include <sstream>
#include <utility>

namespace cellcrush::docs {
namespace {

constexpr const char* kGap = "...";

// What differs between two runs. A number of seconds with an exponent is a step of the solver, and stays.
const std::vector<std::regex>& volatile_values() {
  static const std::vector<std::regex> kValues = [] {
    std::vector<std::regex> values;
    for (const char* value : {
             R"(\b[0-9]{4}-[0-9]{2}-[0-9]{2}(T[0-9:.]+Z)?)",                // dates
             R"((^| )[0-9]+(\.[0-9]+)? (ms|s|min|h)( [0-9]+ (s|min))?\b)",  // times
             R"(STARTS IN)",                                                // the title of a column of times
             R"(\b[0-9]+(\.[0-9]+)? (k|M|G)?(steps|particles)/s\b)",        // rates
             R"(\b[0-9]+(\.[0-9]+)? (B|kB|MB|GB|KiB|MiB|GiB)\b)",           // memory and disk
             R"(\b(127\.0\.0\.1|localhost):[0-9]+)",                        // ports
             R"(\+([0-9a-f]{12}|unknown)(-dirty)?\b)",                      // revisions
         })
      values.emplace_back(std::string(" *") + value + " *");
    return values;
  }();
  return kValues;
}

std::vector<std::string> lines_of_output(const std::string& output) {
  std::vector<std::string> lines;
  std::istringstream stream(output);
  for (std::string line; std::getline(stream, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    lines.push_back(line);
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

// A line as words, to see how much two have in common.
struct Words {
  explicit Words(const std::string& line) {
    static const std::regex kDigits("[0-9]+");
    std::istringstream stream(line);
    for (std::string word; stream >> word;) {
      masked.push_back(std::regex_replace(word, kDigits, "#"));
      exact.push_back(std::move(word));
    }
  }

  std::vector<std::string> exact;
  std::vector<std::string> masked;  ///< digits as #
};

// 1 for lines of the same words in the same order, less for words that differ in their figures, 0 for no common word.
double likeness(const Words& a, const Words& b) {
  constexpr double kOtherFigures = 0.6;
  const std::size_t rows = a.exact.size();
  const std::size_t columns = b.exact.size();
  if (rows + columns == 0) return 1.0;
  std::vector<double> row(columns + 1, 0.0);
  for (std::size_t i = 0; i < rows; ++i) {
    double diagonal = 0.0;
    for (std::size_t j = 0; j < columns; ++j) {
      const double same = a.exact[i] == b.exact[j] ? 1.0 : a.masked[i] == b.masked[j] ? kOtherFigures : 0.0;
      const double best = std::max({row[j], row[j + 1], diagonal + same});
      diagonal = std::exchange(row[j + 1], best);
    }
  }
  return 2.0 * row[columns] / static_cast<double>(rows + columns);
}

struct Line {
  explicit Line(std::string of) : text(std::move(of)), compared(without_volatile(text)), words(compared) {}

  std::string text;
  std::string compared;
  Words words;
};

std::vector<Line> compared_lines(const std::vector<std::string>& texts) { return {texts.begin(), texts.end()}; }

// What it costs to show one line in place of another, to add one or to take one away.
constexpr double kAlike = 0.5;
constexpr double kUnlike = 1.5;
double cost_of(const Line& line) { return line.text.empty() ? 0.2 : 1.0; }
double cost_of(const Line& shown, const Line& line) {
  if (shown.compared == line.compared) return 0.0;
  if (shown.text.empty() || line.text.empty()) return std::numeric_limits<double>::infinity();
  const double alike = likeness(shown.words, line.words);
  return alike < kAlike ? kUnlike : 1.0 - alike + 1e-6;
}

enum class Move : unsigned char { end, leave_gap, skip, replace, add, take_away };

// The cheapest way from shown lines to those of the output, from any pair of places on.
class Alignment {
 public:
  Alignment(const std::vector<Line>& shown, const std::vector<Line>& output)
      : columns_(output.size() + 1), costs_((shown.size() + 1) * columns_), moves_(costs_.size(), Move::end) {
    for (std::size_t i = shown.size() + 1; i-- > 0;) {
      for (std::size_t j = columns_; j-- > 0;) choose(shown, output, i, j);
    }
  }

  [[nodiscard]] Move at(std::size_t i, std::size_t j) const { return moves_[i * columns_ + j]; }

 private:
  void choose(const std::vector<Line>& shown, const std::vector<Line>& output, std::size_t i, std::size_t j) {
    const bool shows = i < shown.size();
    const bool prints = j + 1 < columns_;
    if (!shows && !prints) return;
    double& best = costs_[i * columns_ + j];
    best = std::numeric_limits<double>::infinity();
    const auto consider = [&](Move move, double own, std::size_t next_i, std::size_t next_j) {
      const double cost = own + costs_[next_i * columns_ + next_j];
      if (cost < best) {
        best = cost;
        moves_[i * columns_ + j] = move;
      }
    };
    if (shows && shown[i].text == kGap) {
      consider(Move::leave_gap, 0.0, i + 1, j);
      if (prints) consider(Move::skip, 0.0, i, j + 1);
      return;
    }
    if (shows && prints) consider(Move::replace, cost_of(shown[i], output[j]), i + 1, j + 1);
    if (prints) consider(Move::add, cost_of(output[j]), i, j + 1);
    if (shows) consider(Move::take_away, cost_of(shown[i]), i + 1, j);
  }

  std::size_t columns_;
  std::vector<double> costs_;
  std::vector<Move> moves_;
};

}  // namespace

std::string without_volatile(const std::string& line) {
  std::string text = line;
  for (const std::regex& value : volatile_values()) text = std::regex_replace(text, value, " # ");
  return text;
}

std::vector<std::string> show_again(const std::vector<std::string>& shown, const std::string& output) {
  const std::vector<Line> from = compared_lines(shown);
  const std::vector<Line> to = compared_lines(lines_of_output(output));
  const Alignment alignment(from, to);
  std::vector<std::string> lines;
  std::size_t i = 0;
  std::size_t j = 0;
  for (Move move = alignment.at(i, j); move != Move::end; move = alignment.at(i, j)) {
    if (move == Move::leave_gap) lines.emplace_back(kGap);
    if (move == Move::add) lines.push_back(to[j].text);
    if (move == Move::replace) lines.push_back(from[i].compared == to[j].compared ? from[i].text : to[j].text);
    if (move == Move::leave_gap || move == Move::replace || move == Move::take_away) ++i;
    if (move == Move::skip || move == Move::replace || move == Move::add) ++j;
  }
  return lines;
}

}  // namespace cellcrush::docs
