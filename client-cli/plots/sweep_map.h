#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart/axes.h"
#include "plots/sweep_curves.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

/// The plateau stress at the impact plate over two varied fields.
struct SweepMap {
  Axis x;                                     ///< the first field
  Axis y;                                     ///< the second field
  std::vector<double> across;                 ///< values of the first field, ascending, two at least
  std::vector<double> up;                     ///< values of the second field, ascending, two at least
  std::vector<std::optional<double>> stress;  ///< in `unit`, by up and then across; nothing without a plateau
  std::vector<std::string> modes;             ///< "mode V"; empty if unknown, or if the same everywhere
  ShownUnit unit;
  std::string note;

  [[nodiscard]] std::size_t at(std::size_t column, std::size_t row) const { return row * across.size() + column; }
};

/// The map of a charted_table(). Nothing unless it varies two fields other than the seed, each with two values, and has
/// a row for every pair. Throws CommandError (refused) if no row has a plateau yet, or if an axis cannot be
/// logarithmic.
std::optional<SweepMap> build_sweep_map(const v1::SweepTable& table, const LogarithmicAxes& logarithmic);

/// Draws the map into `place`: a cell of colour around each point with its value and mode where they fit, contour lines
/// at the ticks of the colour bar, interpolated between the points, and the bar on the right.
void draw_sweep_map(cairo_t* context, const Rectangle& place, const SweepMap& map);

}  // namespace cellcrush::client
