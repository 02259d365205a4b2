#pragma once

#include <string>
#include <vector>

#include "chart/canvas.h"

namespace cellcrush::client {

struct Axis {
  double low = 0.0;
  double high = 1.0;
  std::string label;         ///< with its unit
  bool logarithmic = false;  ///< requires low > 0; values not above 0 are not drawn
};

/// Two axes around a plotting area.
class Axes {
 public:
  /// `area` is the plotting area itself; labels are outside it, within kLeft and kBelow.
  Axes(const Rectangle& area, Axis x, Axis y);

  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
  [[nodiscard]] const Rectangle& area() const { return area_; }

  /// Draws the frame, ticks (inwards, on all four sides) and labels over the plot.
  void draw_frame(cairo_t* context) const;

  static constexpr double kLeft = 64.0;
  static constexpr double kBelow = 46.0;

 private:
  Rectangle area_;
  Axis x_;
  Axis y_;
};

/// Round values on an axis: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 0.0;
  std::vector<double> values;  ///< ascending, within the range
};

/// Two to `most` ticks from `low` to `high`. REQUIRES: low < high, both finite, most >= 2.
Ticks find_ticks(double low, double high, int most);

/// A tick's value with as many decimals as its step requires.
std::string tick_label(double value, double step);

/// Two to `most` ticks of a logarithmic axis: powers of ten, with 2 and 5 times these if at most `most` in total; over
/// many decades only every second power, third and so on; on an axis with fewer than two of these, those of
/// find_ticks(). REQUIRES: 0 < low < high, both finite, most >= 2.
Ticks find_logarithmic_ticks(double low, double high, int most);

/// A value of a logarithmic axis, with all its digits.
std::string logarithmic_tick_label(double value);

}  // namespace cellcrush::client
