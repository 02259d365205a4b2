#include "chart/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cellcrush::client {

namespace {

constexpr double kTickLength = 5.0;
constexpr double kUnitsPerTickAcross = 80.0;
constexpr double kUnitsPerTickUp = 42.0;
const TextStyle kTickStyle{.size = 12.0, .anchor = Anchor::middle};

struct Tick {
  double value = 0.0;
  std::string label;
};

std::vector<Tick> ticks_of(const Axis& axis, double length, double units_per_tick) {
  const int most = std::max(2, static_cast<int>(length / units_per_tick) + 1);
  const Ticks found =
      axis.logarithmic ? find_logarithmic_ticks(axis.low, axis.high, most) : find_ticks(axis.low, axis.high, most);
  std::vector<Tick> ticks;
  for (const double value : found.values) {
    ticks.push_back({value, axis.logarithmic ? logarithmic_tick_label(value) : tick_label(value, found.step)});
  }
  return ticks;
}

// Position of a value along an axis: 0 at its low end, 1 at its high end.
double share_of(const Axis& axis, double value) {
  if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
  return (value - axis.low) / (axis.high - axis.low);
}

void line(cairo_t* context, double x0, double y0, double x1, double y1) {
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

}  // namespace

Axes::Axes(const Rectangle& area, Axis x, Axis y) : area_(area), x_(std::move(x)), y_(std::move(y)) {}

double Axes::x(double value) const { return area_.x + area_.width * share_of(x_, value); }

double Axes::y(double value) const { return area_.y + area_.height * (1.0 - share_of(y_, value)); }

void Axes::draw_frame(cairo_t* context) const {
  const double bottom = area_.y + area_.height;
  cairo_set_line_width(context, 1.0);
  set_colour(context, kInk);
  cairo_rectangle(context, area_.x, area_.y, area_.width, area_.height);
  cairo_stroke(context);
  for (const auto& [value, label] : ticks_of(x_, area_.width, kUnitsPerTickAcross)) {
    set_colour(context, kInk);
    line(context, x(value), bottom, x(value), bottom - kTickLength);
    line(context, x(value), area_.y, x(value), area_.y + kTickLength);
    draw_text(context, x(value), bottom + 17.0, label, kTickStyle);
  }
  TextStyle right_aligned = kTickStyle;
  right_aligned.anchor = Anchor::right;
  for (const auto& [value, label] : ticks_of(y_, area_.height, kUnitsPerTickUp)) {
    set_colour(context, kInk);
    line(context, area_.x, y(value), area_.x + kTickLength, y(value));
    line(context, area_.x + area_.width, y(value), area_.x + area_.width - kTickLength, y(value));
    draw_text(context, area_.x - 7.0, y(value) + 4.3, label, right_aligned);
  }
  draw_text(context, area_.x + 0.5 * area_.width, bottom + 38.0, x_.label, {.size = 13.0, .anchor = Anchor::middle});
  draw_text(context, area_.x - 46.0, area_.y + 0.5 * area_.height, y_.label,
            {.size = 13.0, .anchor = Anchor::middle, .upwards = true});
}

Ticks find_ticks(double low, double high, int most) {
  constexpr double kSlack = 1e-9;
  double power = std::pow(10.0, std::floor(std::log10((high - low) / most)));
  Ticks finer;
  while (true) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = factor * power;
      const double first = std::ceil(low / step - kSlack);
      const double last = std::floor(high / step + kSlack);
      if (last - first + 1 > most) {
        finer = {step, {first * step, last * step}};
        continue;
      }
      if (last - first < 1 && !finer.values.empty()) return finer;
      Ticks ticks{step, {}};
      for (double i = first; i <= last; i += 1.0) ticks.values.push_back(i * step);
      return ticks;
    }
    power *= 10.0;
  }
}

std::string tick_label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

Ticks find_logarithmic_ticks(double low, double high, int most) {
  constexpr double kSlack = 1e-9;
  const int first = static_cast<int>(std::floor(std::log10(low) + kSlack));
  const int last = static_cast<int>(std::floor(std::log10(high) + kSlack));
  const auto collect = [&](const std::vector<double>& factors, int stride) {
    Ticks ticks;
    for (int power = first; power <= last; ++power) {
      for (const double factor : factors) {
        const double value = factor * std::pow(10.0, power);
        if (power % stride == 0 && value >= low * (1.0 - kSlack) && value <= high * (1.0 + kSlack)) {
          ticks.values.push_back(value);
        }
      }
    }
    return ticks;
  };
  const Ticks all = collect({1.0, 2.0, 5.0}, 1);
  if (all.values.size() < 2) return find_ticks(low, high, most);
  Ticks ticks = all;
  for (int stride = 1; static_cast<int>(ticks.values.size()) > most; ++stride) ticks = collect({1.0}, stride);
  return ticks.values.size() < 2 ? Ticks{0.0, {all.values.front(), all.values.back()}} : ticks;
}

std::string logarithmic_tick_label(double value) { return fmt::format("{:.6g}", value); }

}  // namespace cellcrush::client
