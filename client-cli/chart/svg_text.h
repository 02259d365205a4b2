#pragma once

#include <string>

#include "chart/canvas.h"

namespace cellcrush::client {

/// Cairo writes text into SVG as outlines that nobody can select, search or edit. This class collects the texts instead
/// and adds them as <text> elements on top of the finished picture.
class SvgTexts {
 public:
  /// Makes `surface`, an SVG, collect its texts here. It must not outlive this object.
  void attach(cairo_surface_t* surface);

  /// The collector of the current surface; null if it has none.
  static SvgTexts* find(cairo_t* context);

  /// A line of text with its anchor at (x, y), both in the context's units.
  void add(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style);

  /// The SVG with the texts in it.
  [[nodiscard]] std::string put_into(const std::string& svg) const;

 private:
  std::string elements_;
};

}  // namespace cellcrush::client
