#include "terminal/sweep_chart_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "chart/axes.h"
#include "plots/sweep_curves.h"
#include "results/sweep_results.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

constexpr int kMostChartColumns = 64;
constexpr int kLabels = 15;  // left of the canvas
constexpr int kRows = 14;
constexpr int kMostTicks = 5;

double plateau(const v1::Summary& summary) { return summary.plateau_stress_impact_mpa(); }

// What the chart is drawn with.
struct Glyphs {
  std::array<const char*, 4> marks;  // of the series, in turn
  const char* theory;
  const char* side;
  const char* tick;
  const char* corner;
  const char* floor;
};

constexpr Glyphs kUnicode = {{"●", "○", "◆", "◇"}, "·", "│", "┤", "└", "─"};
constexpr Glyphs kPlain = {{"o", "x", "*", "+"}, ".", "|", "+", "+", "-"};

struct Range {
  double low;
  double high;

  // The nearest of `count` positions; values outside the range map outside.
  [[nodiscard]] int place(double value, int count) const {
    return static_cast<int>(std::lround((value - low) / (high - low) * (count - 1)));
  }
};

// A field of cells, each a glyph of one column.
class Canvas {
 public:
  Canvas(const Range& x, const Range& y, int columns)
      : x_(x),
        y_(y),
        columns_(columns),
        cells_(kRows, std::vector<std::string>(static_cast<std::size_t>(columns), " ")) {}

  void put(double x, double y, const char* glyph) {
    const int column = x_.place(x, columns_);
    const int row = y_.place(y, kRows);
    if (column < 0 || column >= columns_ || row < 0 || row >= kRows) return;
    cells_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = glyph;
  }

  [[nodiscard]] int columns() const { return columns_; }

  // Rows from the bottom, without trailing spaces.
  [[nodiscard]] std::string row(int number) const {
    std::string text;
    for (const std::string& cell : cells_[static_cast<std::size_t>(number)]) text += cell;
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }

 private:
  Range x_;
  Range y_;
  int columns_;
  std::vector<std::vector<std::string>> cells_;
};

Range range_of_fields(const std::vector<ResultSeries>& all) {
  Range range = {all.front().x.front(), all.front().x.front()};
  for (const ResultSeries& series : all) {
    range.low = std::min(range.low, series.x.front());
    range.high = std::max(range.high, series.x.back());
  }
  if (range.low > 0.0 && range.low < 0.5 * range.high) range.low = 0.0;
  return range;
}

double greatest_plateau(const std::vector<ResultSeries>& all) {
  double greatest = 0.0;
  for (const ResultSeries& series : all) {
    for (const double value : values_of(series, plateau)) greatest = std::max(greatest, value);
  }
  return greatest;
}

// The canvas with its axes; labels stand at the rows and columns of their ticks.
std::string framed(const Canvas& canvas, const Range& x, const Range& y, const Glyphs& glyphs) {
  const Ticks levels = find_ticks(y.low, y.high, kMostTicks);
  std::vector<std::string> labels(kRows);
  for (const double level : levels.values) {
    labels[static_cast<std::size_t>(y.place(level, kRows))] = tick_label(level, levels.step);
  }
  std::size_t width = 0;
  for (const std::string& label : labels) width = std::max(width, label.size());
  std::string text;
  for (int row = kRows - 1; row >= 0; --row) {
    const std::string& label = labels[static_cast<std::size_t>(row)];
    text += fmt::format("  {:>{}} {}{}\n", label, width, label.empty() ? glyphs.side : glyphs.tick, canvas.row(row));
  }
  text += fmt::format("  {:>{}} {}", "", width, glyphs.corner);
  for (int column = 0; column < canvas.columns(); ++column) text += glyphs.floor;
  const Ticks places = find_ticks(x.low, x.high, kMostTicks);
  std::string line(width + 4, ' ');
  for (const double place : places.values) {
    const std::string label = tick_label(place, places.step);
    const std::size_t middle = width + 4 + static_cast<std::size_t>(x.place(place, canvas.columns()));
    line.resize(std::max(line.size() + 1, middle - label.size() / 2), ' ');
    line += label;
  }
  return text + '\n' + line + '\n';
}

std::string legend(const std::vector<ResultSeries>& all, bool with_theory, const Glyphs& glyphs) {
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name.empty()) continue;
    text += fmt::format("  {} {}\n", glyphs.marks[i % glyphs.marks.size()], printable(all[i].name));
  }
  if (with_theory) text += fmt::format("  {} shock theory (Eq. 51)\n", glyphs.theory);
  return text;
}

}  // namespace

std::string sweep_chart_text(const v1::SweepTable& table, bool unicode, int width) {
  const auto all = split_series(table);
  const bool drawable = std::any_of(all.begin(), all.end(), [](const ResultSeries& s) { return s.x.size() > 1; });
  if (!drawable) return {};
  const Range x = range_of_fields(all);
  std::optional<QuadraticFit> shock;
  if (varies_speed_first(table)) shock = find_shock_curve(all.front());
  double top = greatest_plateau(all);
  if (shock.has_value()) top = std::max(top, shock->at(x.high));
  const ShownUnit unit = unit_by_size("MPa", top);
  const Range y = {0.0, 1.05 * unit.factor * top};
  if (!(x.high > x.low && y.high > y.low)) return {};
  const Glyphs& glyphs = unicode ? kUnicode : kPlain;
  const int columns = std::clamp(width - kLabels, 10, kMostChartColumns);
  Canvas canvas(x, y, columns);
  for (int column = 0; shock && column < columns; ++column) {
    const double place = x.low + (x.high - x.low) * column / (columns - 1);
    canvas.put(place, unit.factor * shock->at(place), glyphs.theory);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto stresses = values_of(all[i], plateau);
    for (std::size_t k = 0; k < stresses.size(); ++k) {
      canvas.put(all[i].x[k], unit.factor * stresses[k], glyphs.marks[i % glyphs.marks.size()]);
    }
  }
  return "\n" +
         wrapped(
             fmt::format("plateau stress at the impact plate ({}) against {}", unit.name, axis_label(table.fields(0))),
             width) +
         framed(canvas, x, y, glyphs) + legend(all, shock.has_value(), glyphs);
}

}  // namespace cellcrush::client
