#pragma once

#include <string>

#include "chart/canvas.h"

namespace cellcrush::client {

/// Cairo writes text into SVG as outlines, which nobody can select, search or edit. Here the texts are collected
/// instead and put as <text> elements on top of the finished picture.
class SvgTexts {
 public:
  /// Makes `surface`, an SVG, collect its texts here. It must not outlive this.
  void attach(cairo_surface_t* surface);

  /// The collector of what is drawn on; null for a surface without one.
  static SvgTexts* find(cairo_t* context);

  /// A line of text with its anchor at (x, y), both in the context's units.
  void add(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style);

  /// The SVG with the texts in it.
  [[nodiscard]] std::string put_into(const std::string& svg) const;

 private:
  std::string elements_;
};

}  // namespace cellcrush::client
