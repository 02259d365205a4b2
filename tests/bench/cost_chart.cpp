#include "bench/cost_chart.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <stdexcept>

#include "bench/picture_file.h"
#include "cellcrush/simd.h"
#include "chart/axes.h"
#include "chart/colour_map.h"

namespace cellcrush::bench {
namespace {

constexpr double kWidth = 760.0;
constexpr double kRow = 19.0;
constexpr double kBar = 12.0;
constexpr double kNames = 150.0;
constexpr double kRatios = 44.0;
constexpr double kMargin = 14.0;
constexpr double kTop = kMargin + 26.0;
constexpr double kBelow = 48.0;
constexpr client::Colour kFaint{0.85, 0.85, 0.87};
const std::string kReference = "type-i-default/20";

/// Stages that share a colour.
struct Part {
  const char* name;
  std::vector<const char*> counters;
};
const Part kParts[] = {
    {"walls", {"evaluate_internal_forces_ns"}},
    {"contacts", {"find_contacts_ns", "evaluate_contact_forces_ns"}},
    {"motion, plates, loads", {"integrate_motion_ns", "evaluate_plate_forces_ns", "evaluate_loads_ns"}}};

double sum_of(const Part& part, const Measured& row) {
  double sum = 0.0;
  for (const char* counter : part.counters) sum += row.counters.at(counter);
  return sum;
}

void fill(cairo_t* context, const client::Rectangle& bar, int colour) {
  client::set_colour(context, client::kSeriesColours[colour]);
  cairo_rectangle(context, bar.x, bar.y, bar.width, bar.height);
  cairo_fill(context);
}

void draw_legend(cairo_t* context) {
  double x = kNames;
  for (int i = 0; i < static_cast<int>(std::size(kParts)); ++i) {
    fill(context, {x, kMargin, kBar, kBar}, i);
    client::draw_text(context, x + kBar + 5.0, kMargin + kBar - 1.5, kParts[i].name);
    x += kBar + 22.0 + client::text_width(context, kParts[i].name);
  }
}

/// Vertical lines at round times, down to `bottom`.
void draw_times(cairo_t* context, double units_per_ns, double most, double bottom) {
  const client::Ticks ticks = client::find_ticks(0.0, most, 7);
  cairo_set_line_width(context, 0.6);
  for (const double time : ticks.values) {
    const double x = kNames + units_per_ns * time;
    client::set_colour(context, kFaint);
    cairo_move_to(context, x, kTop);
    cairo_line_to(context, x, bottom);
    cairo_stroke(context);
    client::draw_text(context, x, bottom + 16.0, client::tick_label(time, ticks.step),
                      {.anchor = client::Anchor::middle});
  }
  client::draw_text(context, kNames, bottom + 36.0,
                    "time of an element-step (ns); beside each bar its ratio to " + kReference);
}

/// The parts of a bar, one after the other.
void draw_bar(cairo_t* context, const Measured& row, double y, double units_per_ns, double reference) {
  const double base = y + kBar - 1.5;
  const std::string name = row.benchmark.substr(0, row.benchmark.rfind('/'));
  client::draw_text(context, kNames - 8.0, base, name, {.anchor = client::Anchor::right});
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(std::size(kParts)); ++i) {
    const double part = sum_of(kParts[i], row);
    fill(context, {kNames + units_per_ns * sum, y, units_per_ns * part, kBar}, i);
    sum += part;
  }
  char ratio[16];
  std::snprintf(ratio, sizeof(ratio), "%.3g", row.counters.at("element_step_ns") / reference);
  client::draw_text(context, kNames + units_per_ns * sum + 6.0, base, ratio, {.colour = client::kMutedInk});
}

}  // namespace

void draw_costs(const std::string& file, const std::vector<Measured>& measured) {
  std::vector<Measured> rows;
  std::ranges::copy_if(measured, std::back_inserter(rows),
                       [](const Measured& row) { return row.label == simd_targets().front(); });
  const auto reference =
      std::ranges::find_if(rows, [](const Measured& row) { return row.benchmark.starts_with(kReference + "/"); });
  if (reference == rows.end()) {
    throw std::invalid_argument("--chart=" + file + ": takes " + kReference + "; let the filter pass it.");
  }
  double most = 0.0;
  for (const Measured& row : rows) most = std::max(most, row.counters.at("element_step_ns"));
  const double units_per_ns = (kWidth - kNames - kRatios - kMargin) / most;
  const double bottom = kTop + kRow * static_cast<double>(rows.size());
  write_picture(file, kWidth, bottom + kBelow, [&](cairo_t* context) {
    draw_legend(context);
    draw_times(context, units_per_ns, most, bottom);
    double y = kTop + 0.5 * (kRow - kBar);
    for (const Measured& row : rows) {
      draw_bar(context, row, y, units_per_ns, reference->counters.at("element_step_ns"));
      y += kRow;
    }
  });
}

}  // namespace cellcrush::bench
