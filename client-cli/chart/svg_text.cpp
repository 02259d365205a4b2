#include "chart/svg_text.h"

#include <fmt/format.h>

#include <cmath>

#include "terminal/display_text.h"

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

}  // namespace

void SvgTexts::attach(cairo_surface_t* surface) { cairo_surface_set_user_data(surface, &kKey, this, nullptr); }

SvgTexts* SvgTexts::find(cairo_t* context) {
  return static_cast<SvgTexts*>(cairo_surface_get_user_data(cairo_get_target(context), &kKey));
}

void SvgTexts::add(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style) {
  if (text.empty()) return;
  cairo_user_to_device(context, &x, &y);
  elements_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"{}\" "
      "text-anchor=\"{}\" fill=\"#{:02x}{:02x}{:02x}\"",
      x, y, style.size, anchor_text(style.anchor), byte_of(style.colour.red), byte_of(style.colour.green),
      byte_of(style.colour.blue));
  if (style.bold) elements_ += " font-weight=\"bold\"";
  if (style.upwards) elements_ += fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y);
  elements_ += ">" + escaped(printable(text)) + "</text>\n";
}

std::string SvgTexts::put_into(const std::string& svg) const {
  const std::size_t end = svg.rfind("</svg>");
  return svg.substr(0, end) + elements_ + svg.substr(end);
}

}  // namespace cellcrush::client
