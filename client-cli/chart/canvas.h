#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>

namespace cellcrush::client {

/// Red, green, blue and opacity, 0 to 1.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double opacity = 1.0;
};

inline constexpr Colour kInk{0.13, 0.13, 0.15};
inline constexpr Colour kMutedInk{0.42, 0.42, 0.46};

/// A rectangle in units of a picture (1/96 inch), y downwards.
struct Rectangle {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};

enum class PictureFormat { png, svg, pdf };

/// The format for a file name. Throws std::invalid_argument unless it ends in .png, .svg or .pdf.
PictureFormat picture_format(const std::filesystem::path& file);

/// Pixels per unit in PNG pictures.
inline constexpr int kPixelsPerUnit = 2;

/// The bytes of a picture on a white background; `draw` draws in units. Throws std::runtime_error if it fails.
std::string render_picture(PictureFormat format, double width, double height,
                           const std::function<void(cairo_t*)>& draw);

void set_colour(cairo_t* context, const Colour& colour);

enum class Anchor { left, middle, right };

/// Style and alignment of a text.
struct TextStyle {
  double size = 12.0;
  Colour colour = kInk;
  Anchor anchor = Anchor::left;
  bool bold = false;
  bool upwards = false;  ///< rotated by 90 degrees, read from bottom to top
};

/// Draws a line of text (UTF-8) with the anchor of its baseline at (x, y).
void draw_text(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style = {});

/// Width of a line of text.
double text_width(cairo_t* context, const std::string& text, const TextStyle& style = {});

/// The text, truncated with "..." to at most `width`.
std::string fit_text(cairo_t* context, const std::string& text, double width, const TextStyle& style = {});

}  // namespace cellcrush::client
