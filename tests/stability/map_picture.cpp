#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stability/stability_map.h"

namespace cellcrush::stability {
namespace {

using client::Anchor;
using client::Colour;

constexpr double kCellWidth = 38.0;
constexpr double kCellHeight = 24.0;
constexpr double kLeft = 60.0;   // of a panel, for its labels
constexpr double kAbove = 30.0;  // for its heading
constexpr double kBelow = 44.0;
constexpr double kHead = 62.0;  // of the picture
constexpr int kPanelsAcross = 2;

Colour colour_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::stable: return {0.60, 0.80, 0.90};
    case Outcome::drifting: return {0.98, 0.78, 0.35};
    case Outcome::lost: break;
  }
  return {0.75, 0.30, 0.24};
}

/// The worse of the two errors of the energy, in per cent.
std::string error_text(const Result& result) {
  const double percent = 100.0 * std::max(result.energy_error, result.contact_energy);
  return result.outcome == Outcome::lost ? ""
         : percent < 0.095               ? fmt::format("{:.2f}", percent)
                                         : fmt::format("{:.1f}", percent);
}

/// Where a value lies among ascending ones, in cells; beyond them at their edge. On a logarithmic scale between two.
double place_among(const std::vector<double>& values, double value) {
  const auto above = std::upper_bound(values.begin(), values.end(), value);
  if (above == values.begin()) {
    return 0.0;
  }
  const double low = *(above - 1);
  const double share = above == values.end() ? 0.5 : std::log(value / low) / std::log(*above / low);
  return static_cast<double>(above - 1 - values.begin()) + share;
}

class Panel {
 public:
  Panel(cairo_t* context, const Grid& grid, double x, double y) : context_(context), grid_(grid), x_(x), y_(y) {}

  void draw_cells(const Result* results) const {
    for (std::size_t row = 0; row < grid_.penalties.size(); ++row) {
      for (std::size_t column = 0; column < grid_.steps.size(); ++column) {
        const Result& result = results[row * grid_.steps.size() + column];
        const double left = x_of(static_cast<double>(column));
        const double top = y_of(static_cast<double>(row));
        cairo_rectangle(context_, left, top, kCellWidth - 1.0, kCellHeight - 1.0);
        client::set_colour(context_, colour_of(result.outcome));
        cairo_fill(context_);
        client::draw_text(context_, left + 0.5 * kCellWidth, top + 16.0, error_text(result),
                          {.size = 10.5, .anchor = Anchor::middle});
      }
    }
  }

  void draw_labels(double speed) const {
    const double middle = x_of(0.5 * static_cast<double>(grid_.steps.size()));
    const double bottom = y_of(-1.0);
    client::draw_text(context_, middle, y_ - 9.0, fmt::format("{:g} m/s", speed),
                      {.size = 13.0, .anchor = Anchor::middle, .bold = true});
    for (std::size_t i = 0; i < grid_.steps.size(); ++i) {
      client::draw_text(context_, x_of(static_cast<double>(i) + 0.5), bottom + 15.0,
                        fmt::format("{:g}", grid_.steps[i]), {.size = 11.0, .anchor = Anchor::middle});
    }
    for (std::size_t i = 0; i < grid_.penalties.size(); ++i) {
      client::draw_text(context_, x_ - 6.0, y_of(static_cast<double>(i)) + 16.0,
                        fmt::format("{:g}", grid_.penalties[i]), {.size = 11.0, .anchor = Anchor::right});
    }
    client::draw_text(context_, middle, bottom + 33.0, "dt / dt_crit", {.size = 12.0, .anchor = Anchor::middle});
    client::draw_text(context_, x_ - 42.0, y_of(0.5 * static_cast<double>(grid_.penalties.size()) - 1.0),
                      "k dt_crit\u00b2 / m", {.size = 12.0, .anchor = Anchor::middle, .upwards = true});
  }

  void draw_default(const Point& point) const {
    cairo_arc(context_, x_of(place_among(grid_.steps, point.step) + 0.5),
              y_of(place_among(grid_.penalties, point.penalty)) + 0.5 * kCellHeight, 9.0, 0.0, 2.0 * std::numbers::pi);
    client::set_colour(context_, client::kInk);
    cairo_set_line_width(context_, 2.0);
    cairo_stroke(context_);
  }

 private:
  [[nodiscard]] double x_of(double column) const { return x_ + column * kCellWidth; }
  /// Upper edge of a row; rows run upwards.
  [[nodiscard]] double y_of(double row) const {
    return y_ + (static_cast<double>(grid_.penalties.size()) - 1.0 - row) * kCellHeight;
  }

  cairo_t* context_;
  const Grid& grid_;
  double x_;
  double y_;
};

void draw_head(cairo_t* context, const std::string& title) {
  client::draw_text(context, kLeft, 26.0, title, {.size = 15.0, .bold = true});
  double x = kLeft;
  const auto key = [&](const Colour& colour, const std::string& text) {
    cairo_rectangle(context, x, 38.0, 14.0, 14.0);
    client::set_colour(context, colour);
    cairo_fill(context);
    client::draw_text(context, x + 20.0, 49.5, text);
    x += 44.0 + client::text_width(context, text);
  };
  key(colour_of(Outcome::stable), "stable: energy error in %");
  key(colour_of(Outcome::drifting), "drifting: over 1 %");
  key(colour_of(Outcome::lost), "lost: ended by its check");
  cairo_arc(context, x + 7.0, 45.0, 7.0, 0.0, 2.0 * std::numbers::pi);
  client::set_colour(context, client::kInk);
  cairo_set_line_width(context, 2.0);
  cairo_stroke(context);
  client::draw_text(context, x + 20.0, 49.5, "chosen by the solver (at the edge: beyond it)");
}

}  // namespace

std::string draw_map(client::PictureFormat format, const Grid& grid, const std::vector<Result>& results,
                     const std::vector<Result>& defaults, const std::string& title) {
  const auto columns = static_cast<double>(grid.steps.size());
  const auto rows = static_cast<double>(grid.penalties.size());
  const double panel_width = kLeft + columns * kCellWidth + 16.0;
  const double panel_height = kAbove + rows * kCellHeight + kBelow;
  const int panels_up = (static_cast<int>(grid.speeds.size()) + kPanelsAcross - 1) / kPanelsAcross;
  return client::render_picture(format, kPanelsAcross * panel_width, kHead + panels_up * panel_height,
                                [&](cairo_t* context) {
                                  draw_head(context, title);
                                  for (std::size_t i = 0; i < grid.speeds.size(); ++i) {
                                    const std::size_t across = i % kPanelsAcross;
                                    const std::size_t up = i / kPanelsAcross;
                                    const Panel panel(context, grid, static_cast<double>(across) * panel_width + kLeft,
                                                      kHead + static_cast<double>(up) * panel_height + kAbove);
                                    panel.draw_cells(&results[i * grid.penalties.size() * grid.steps.size()]);
                                    panel.draw_labels(grid.speeds[i]);
                                    panel.draw_default(defaults[i].point);
                                  }
                                });
}

}  // namespace cellcrush::stability
