#include "chart/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

#include "chart/display_text.h"

namespace cellcrush::client {

namespace {

const cairo_user_data_key_t kKey = {};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char byte : text) {
    switch (byte) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      default: result += byte;
    }
  }
  return result;
}

const char* anchor_text(Anchor anchor) {
  return anchor == Anchor::left ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

int byte_of(double share) { return static_cast<int>(std::lround(255.0 * share)); }

/// Cairo writes text into SVG as outlines that nobody can select, search or edit. This class collects the texts instead
/// and adds them as <text> elements on top of the finished picture.
class SvgTexts {
 public:
  /// Makes `surface`, an SVG, collect its texts here. It must not outlive this object.
  void attach(cairo_surface_t* surface) { cairo_surface_set_user_data(surface, &kKey, this, nullptr); }
  /// The collector of the current surface; null if it has none.
  static SvgTexts* find(cairo_t* context) {
    return static_cast<SvgTexts*>(cairo_surface_get_user_data(cairo_get_target(context), &kKey));
  }
  /// A line of text with its anchor at (x, y), both in the context's units.
  void add(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style) {
    if (text.empty()) return;
    cairo_user_to_device(context, &x, &y);
    double size = style.size;
    double none = 0.0;
    cairo_user_to_device_distance(context, &none, &size);  // a length downwards, also of a text upwards
    elements_ += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"{}\" "
        "text-anchor=\"{}\" fill=\"#{:02x}{:02x}{:02x}\"",
        x, y, size, anchor_text(style.anchor), byte_of(style.colour.red), byte_of(style.colour.green),
        byte_of(style.colour.blue));
    if (style.bold) elements_ += " font-weight=\"bold\"";
    if (style.upwards) elements_ += fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y);
    elements_ += ">" + escaped(printable(text)) + "</text>\n";
  }
  /// The SVG with the texts in it.
  [[nodiscard]] std::string put_into(const std::string& svg) const {
    const std::size_t end = svg.rfind("</svg>");
    return svg.substr(0, end) + elements_ + svg.substr(end);
  }

 private:
  std::string elements_;
};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append_bytes(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(std::string("the picture cannot be drawn: ") + cairo_status_to_string(status));
}

// Units of the surface per picture unit: pixels of a PNG, points (1/72 inch) of a PDF, millimetres of a printed SVG.
double device_units(PictureFormat format, const PrintSize& print) {
  switch (format) {
    case PictureFormat::png: return kPixelsPerUnit * print.scale();
    case PictureFormat::pdf: return 0.75 * print.scale();
    default: return print.is_default() ? 1.0 : 25.4 / 96.0 * print.scale();
  }
}

Surface make_surface(PictureFormat format, double width, double height, const PrintSize& print, std::string& bytes) {
  const double scale = device_units(format, print);
  const auto make = [&] {
    switch (format) {
      case PictureFormat::svg: {
        auto* surface = cairo_svg_surface_create_for_stream(append_bytes, &bytes, scale * width, scale * height);
        if (!print.is_default()) cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_MM);
        return surface;
      }
      case PictureFormat::pdf:
        return cairo_pdf_surface_create_for_stream(append_bytes, &bytes, scale * width, scale * height);
      default:
        return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(scale * width)),
                                          static_cast<int>(std::ceil(scale * height)));
    }
  };
  return {make(), cairo_surface_destroy};
}

void set_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size);
}

}  // namespace

PictureFormat picture_format(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (extension == ".png") return PictureFormat::png;
  if (extension == ".svg") return PictureFormat::svg;
  if (extension == ".pdf") return PictureFormat::pdf;
  throw std::invalid_argument(file.string() + ": a picture's name ends in .png, .svg or .pdf");
}

std::string render_picture(PictureFormat format, double width, double height, const std::function<void(cairo_t*)>& draw,
                           const PrintSize& print) {
  std::string bytes;
  SvgTexts texts;
  {
    const Surface surface = make_surface(format, width, height, print, bytes);
    check(cairo_surface_status(surface.get()));
    if (format == PictureFormat::svg) texts.attach(surface.get());
    const Context context(cairo_create(surface.get()), cairo_destroy);
    const double scale = device_units(format, print);
    cairo_scale(context.get(), scale, scale);
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    draw(context.get());
    check(cairo_status(context.get()));
    if (format == PictureFormat::png) check(cairo_surface_write_to_png_stream(surface.get(), append_bytes, &bytes));
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));
  }
  return format == PictureFormat::svg ? texts.put_into(bytes) : bytes;
}

void set_colour(cairo_t* context, const Colour& colour) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.opacity);
}

void draw_text(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style) {
  if (SvgTexts* texts = SvgTexts::find(context)) return texts->add(context, x, y, text, style);
  const double width = text_width(context, text, style);
  const double shift = style.anchor == Anchor::left ? 0.0 : style.anchor == Anchor::middle ? -0.5 * width : -width;
  cairo_save(context);
  cairo_translate(context, x, y);
  if (style.upwards) cairo_rotate(context, -0.5 * std::numbers::pi);
  cairo_move_to(context, shift, 0.0);
  set_colour(context, style.colour);
  cairo_show_text(context, printable(text).c_str());
  cairo_restore(context);
  cairo_new_path(context);
}

double text_width(cairo_t* context, const std::string& text, const TextStyle& style) {
  set_font(context, style);
  cairo_text_extents_t extents;
  cairo_text_extents(context, printable(text).c_str(), &extents);
  return extents.x_advance;
}

std::vector<std::string> wrap_to_width(cairo_t* context, const std::string& text, double width,
                                       const TextStyle& style) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back() + (lines.back().empty() ? "" : " ") + word;
    if (lines.back().empty() || text_width(context, longer, style) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::string fit_text(cairo_t* context, const std::string& text, double width, const TextStyle& style) {
  std::string fitted = text;
  for (int columns = display_width(text) - 1; columns > 8 && text_width(context, fitted, style) > width; --columns) {
    fitted = cut(text, columns);
  }
  return fitted;
}

}  // namespace cellcrush::client
