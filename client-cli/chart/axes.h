#pragma once

#include <string>

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

}  // namespace cellcrush::client
