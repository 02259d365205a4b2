#pragma once

#include <string>

#include "chart/canvas.h"

namespace cellcrush::client {

struct Axis {
  double low = 0.0;
  double high = 1.0;
  std::string label;         ///< with its unit
  bool logarithmic = false;  ///< then 0 < low; what is not above 0 has no place on it
};

/// Two axes round a plotting area.
class Axes {
 public:
  /// `area` is the plotting area itself; labels stand outside of it, within kLeft and kBelow.
  Axes(const Rectangle& area, Axis x, Axis y);

  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
  [[nodiscard]] const Rectangle& area() const { return area_; }

  /// The frame, ticks (inwards, on all four sides) and labels, over what was plotted.
  void draw_frame(cairo_t* context) const;

  static constexpr double kLeft = 64.0;
  static constexpr double kBelow = 46.0;

 private:
  Rectangle area_;
  Axis x_;
  Axis y_;
};

}  // namespace cellcrush::client
