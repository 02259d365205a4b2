#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

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

/// How a picture is printed: its width, and the size of the text of its axes. A smaller text makes lines and marks
/// smaller in proportion, and leaves more room between them.
struct PrintSize {
  static constexpr double kDefaultFontPt = 9.0;  ///< 12 units

  double width_mm = 0.0;  ///< 0: as wide as the picture is by default
  double font_pt = kDefaultFontPt;

  /// 1/96 inch per unit of the picture.
  [[nodiscard]] double scale() const { return font_pt / kDefaultFontPt; }
  /// The width in units, or `default_width`.
  [[nodiscard]] double width(double default_width) const {
    return width_mm > 0.0 ? width_mm / 25.4 * 96.0 / scale() : default_width;
  }
  [[nodiscard]] bool is_default() const { return width_mm == 0.0 && font_pt == kDefaultFontPt; }
};

/// The bytes of a picture on a white background; `draw` draws in units. An SVG or PDF of another than the default size
/// states it in millimetres or points. Throws std::runtime_error if it fails.
std::string render_picture(PictureFormat format, double width, double height, const std::function<void(cairo_t*)>& draw,
                           const PrintSize& print = {});

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

/// The words of a text in lines of at most `width`, a longer word alone; at least one line.
std::vector<std::string> wrap_to_width(cairo_t* context, const std::string& text, double width,
                                       const TextStyle& style = {});

/// The text, truncated with "..." to at most `width`.
std::string fit_text(cairo_t* context, const std::string& text, double width, const TextStyle& style = {});

}  // namespace cellcrush::client
