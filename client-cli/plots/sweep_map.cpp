#include "plots/sweep_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "chart/chart.h"
#include "chart/colour_map.h"
#include "command_error.h"
#include "results/sweep_results.h"
#include "terminal/summary_text.h"

namespace cellcrush::client {

namespace {

constexpr int kMostLevels = 8;
constexpr double kLegendRoom = 92.0;  // right of the cells
constexpr double kBarWidth = 14.0;

std::vector<double> values_of_field(const v1::SweepTable& table, int field) {
  std::vector<double> values;
  for (const auto& row : table.rows()) values.push_back(row.values(field));
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// The borders of the cells around values: halfway between them, in the logarithm on a logarithmic axis. Those of values
// that are not negative begin at 0 at the lowest.
std::vector<double> borders_of(const std::vector<double>& values, bool logarithmic) {
  const auto to = [&](double value) { return logarithmic ? std::log(value) : value; };
  const auto from = [&](double value) { return logarithmic ? std::exp(value) : value; };
  std::vector<double> borders = {from(1.5 * to(values[0]) - 0.5 * to(values[1]))};
  for (std::size_t i = 1; i < values.size(); ++i) borders.push_back(from(0.5 * (to(values[i - 1]) + to(values[i]))));
  borders.push_back(from(1.5 * to(values.back()) - 0.5 * to(values[values.size() - 2])));
  if (values.front() >= 0.0) borders.front() = std::max(borders.front(), 0.0);
  return borders;
}

Axis axis_of(const std::string& field, const std::vector<double>& values, bool logarithmic, char letter) {
  if (logarithmic && values.front() <= 0.0) {
    refuse(fmt::format("{0} has values that are not above 0, which --log {1} requires; leave --log {1} out", field,
                       letter));
  }
  const std::vector<double> borders = borders_of(values, logarithmic);
  return {borders.front(), borders.back(), axis_label(field), logarithmic};
}

struct StressRange {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();

  [[nodiscard]] double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

StressRange range_of(const SweepMap& map) {
  StressRange range;
  for (const auto& stress : map.stress) {
    if (!stress) continue;
    range.low = std::min(range.low, *stress);
    range.high = std::max(range.high, *stress);
  }
  return range;
}

Ticks levels_of(const StressRange& range) {
  return range.high > range.low ? find_ticks(range.low, range.high, kMostLevels) : Ticks{};
}

Colour colour_of(const std::optional<double>& stress, const StressRange& range) {
  return stress ? map_colour(range.share(*stress)) : Colour{0.93, 0.93, 0.93};
}

// Overlaps the cells to the right and above, which are drawn later, so that no seam shows.
void fill_cell(cairo_t* context, const Rectangle& cell, const std::optional<double>& stress, const StressRange& range) {
  constexpr double kOverlap = 0.6;
  set_colour(context, colour_of(stress, range));
  cairo_rectangle(context, cell.x, cell.y - kOverlap, cell.width + kOverlap, cell.height + kOverlap);
  cairo_fill(context);
}

// The value and the mode of a point, where they fit into its cell.
void label_cell(cairo_t* context, const Rectangle& cell, const std::optional<double>& stress, const std::string& mode,
                const StressRange& range) {
  const bool is_bright = !stress || range.share(*stress) > 0.7;
  const TextStyle style{.size = 10.5, .colour = is_bright ? kInk : Colour{1.0, 1.0, 1.0}, .anchor = Anchor::middle};
  const auto fits = [&](const std::string& text) { return text_width(context, text, style) + 4.0 <= cell.width; };
  const std::string value = stress ? number_text(*stress) : "–";
  if (!fits(value) || cell.height < 16.0) return;
  const std::string letter = fits(mode) ? mode : mode.substr(mode.rfind(' ') + 1);
  const bool has_mode = !letter.empty() && cell.height >= 30.0;
  const double middle = cell.y + 0.5 * cell.height + 4.0;
  const auto write = [&](double baseline, const std::string& text) {
    const double width = text_width(context, text, style) + 4.0;
    set_colour(context, colour_of(stress, range));  // over the contours
    cairo_rectangle(context, cell.x + 0.5 * (cell.width - width), baseline - 10.5, width, 14.5);
    cairo_fill(context);
    draw_text(context, cell.x + 0.5 * cell.width, baseline, text, style);
  };
  write(has_mode ? middle - 7.0 : middle, value);
  if (has_mode) write(middle + 7.0, letter);
}

// The lines of one level in the rectangle between four neighbouring points, by linear interpolation along its sides.
// Where they could join in two ways, the mean of the corners decides.
void trace_level(cairo_t* context, const std::array<std::pair<double, double>, 4>& corners,
                 const std::array<double, 4>& stress, double level) {
  std::vector<std::pair<double, double>> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    if ((stress[i] < level) == (stress[next] < level)) continue;
    const double share = (level - stress[i]) / (stress[next] - stress[i]);
    crossings.emplace_back(std::lerp(corners[i].first, corners[next].first, share),
                           std::lerp(corners[i].second, corners[next].second, share));
  }
  const double middle = 0.25 * (stress[0] + stress[1] + stress[2] + stress[3]);
  if (crossings.size() == 4 && (middle < level) != (stress[0] < level)) {
    std::rotate(crossings.begin(), crossings.begin() + 1, crossings.end());
  }
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    cairo_move_to(context, crossings[i].first, crossings[i].second);
    cairo_line_to(context, crossings[i + 1].first, crossings[i + 1].second);
  }
}

void draw_contours(cairo_t* context, const Axes& axes, const SweepMap& map, const Ticks& levels) {
  cairo_set_line_width(context, 1.2);
  set_colour(context, {1.0, 1.0, 1.0, 0.85});
  for (std::size_t row = 0; row + 1 < map.up.size(); ++row) {
    for (std::size_t column = 0; column + 1 < map.across.size(); ++column) {
      std::array<std::pair<double, double>, 4> corners;
      std::array<double, 4> stress{};
      bool complete = true;
      constexpr std::array<std::pair<std::size_t, std::size_t>, 4> kCorners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      for (std::size_t i = 0; i < kCorners.size(); ++i) {
        const auto [right, above] = kCorners[i];
        corners[i] = {axes.x(map.across[column + right]), axes.y(map.up[row + above])};
        const auto& value = map.stress[map.at(column + right, row + above)];
        complete = complete && value.has_value();
        stress[i] = value.value_or(0.0);
      }
      for (const double level : levels.values) {
        if (complete) trace_level(context, corners, stress, level);
      }
    }
  }
  cairo_stroke(context);
}

void draw_bar(cairo_t* context, const Rectangle& area, const SweepMap& map, const StressRange& range,
              const Ticks& levels) {
  const Rectangle bar{area.x + area.width + 18.0, area.y, kBarWidth, area.height};
  constexpr int kSteps = 128;
  for (int i = 0; i < kSteps; ++i) {
    set_colour(context, map_colour((i + 0.5) / kSteps));
    const double step = bar.height / kSteps;
    cairo_rectangle(context, bar.x, bar.y + bar.height - (i + 1) * step, bar.width, step + 0.3);
    cairo_fill(context);
  }
  for (const double level : levels.values) {
    const double y = bar.y + bar.height * (1.0 - range.share(level));
    set_colour(context, {1.0, 1.0, 1.0, 0.85});
    cairo_set_line_width(context, 1.2);
    cairo_move_to(context, bar.x, y);
    cairo_line_to(context, bar.x + bar.width, y);
    cairo_stroke(context);
    draw_text(context, bar.x + bar.width + 5.0, y + 4.0, tick_label(level, levels.step), {.size = 11.0});
  }
  draw_text(context, bar.x + bar.width + 50.0, bar.y + 0.5 * bar.height,
            fmt::format("plateau stress, impact plate ({})", map.unit.name),
            {.size = 12.0, .anchor = Anchor::middle, .upwards = true});
}

}  // namespace

std::optional<SweepMap> build_sweep_map(const v1::SweepTable& table, const LogarithmicAxes& logarithmic) {
  if (table.fields_size() != 2 || std::ranges::find(table.fields(), kSeedField) != table.fields().end()) {
    return std::nullopt;
  }
  if (std::ranges::any_of(table.rows(), [](const auto& row) { return row.values_size() != 2; })) return std::nullopt;
  SweepMap map;
  map.across = values_of_field(table, 0);
  map.up = values_of_field(table, 1);
  const std::size_t size = map.across.size() * map.up.size();
  if (map.across.size() < 2 || map.up.size() < 2 || static_cast<std::size_t>(table.rows_size()) != size) {
    return std::nullopt;
  }
  map.x = axis_of(table.fields(0), map.across, logarithmic.x, 'x');
  map.y = axis_of(table.fields(1), map.up, logarithmic.y, 'y');
  map.stress.resize(size);
  map.modes.resize(size);
  double largest = 0.0;
  std::map<std::string, std::string> words;  // of the modes
  for (const auto& row : table.rows()) {
    const v1::Summary& summary = row.result().summary();
    if (row.result().state() != v1::Job::SUCCEEDED || !summary.has_plateau_stress_impact_mpa()) continue;
    const auto place = [](const std::vector<double>& values, double value) {
      return static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin());
    };
    const std::size_t at = map.at(place(map.across, row.values(0)), place(map.up, row.values(1)));
    map.stress[at] = summary.plateau_stress_impact_mpa();
    largest = std::max(largest, summary.plateau_stress_impact_mpa());
    if (summary.crush_mode() <= v1::Summary::CRUSH_MODE_NONE) continue;
    map.modes[at] = "mode " + crush_mode_code(summary.crush_mode());
    words[map.modes[at]] = summary.crush_mode_words();
  }
  const auto known = std::ranges::count_if(map.stress, [](const auto& stress) { return stress.has_value(); });
  if (known == 0) refuse(kNoPlateauYet);
  map.unit = unit_by_size("MPa", largest);
  for (auto& stress : map.stress) {
    if (stress) *stress *= map.unit.factor;
  }
  map.note = "lines: contours between the points";
  if (words.size() == 1) {
    map.note += "; crush mode: " + words.begin()->second;
    map.modes.assign(size, {});
  }
  if (!table.means().empty()) map.note = "means over the seeds; " + map.note;
  int warned = 0;
  for (const auto& row : table.rows()) warned += row.result().summary().warnings_size() > 0 ? 1 : 0;
  for (const auto& means : table.means()) warned += means.warned_count();
  if (warned > 0) map.note += fmt::format("; {} run{} with warnings", warned, warned == 1 ? "" : "s");
  if (known < table.rows_size()) map.note += fmt::format("; {} of {} have no plateau", table.rows_size() - known, size);
  return map;
}

void draw_sweep_map(cairo_t* context, const Rectangle& place, const SweepMap& map) {
  const double note_width = place.width - kLegendRoom;
  const double below = Axes::kBelow + note_height(context, note_width, map.note);
  const Axes axes({place.x + Axes::kLeft, place.y + 8.0, note_width - Axes::kLeft, place.height - 8.0 - below}, map.x,
                  map.y);
  const StressRange range = range_of(map);
  const Ticks levels = levels_of(range);
  const std::vector<double> across = borders_of(map.across, map.x.logarithmic);
  const std::vector<double> up = borders_of(map.up, map.y.logarithmic);
  const auto for_cells = [&](const auto& visit) {
    for (std::size_t row = 0; row < map.up.size(); ++row) {
      for (std::size_t column = 0; column < map.across.size(); ++column) {
        const double left = axes.x(across[column]);
        const double top = axes.y(up[row + 1]);
        visit(Rectangle{left, top, axes.x(across[column + 1]) - left, axes.y(up[row]) - top}, map.at(column, row));
      }
    }
  };
  const Rectangle& area = axes.area();
  cairo_save(context);
  cairo_rectangle(context, area.x, area.y, area.width, area.height);
  cairo_clip(context);
  for_cells([&](const Rectangle& cell, std::size_t at) { fill_cell(context, cell, map.stress[at], range); });
  draw_contours(context, axes, map, levels);
  for_cells(
      [&](const Rectangle& cell, std::size_t at) { label_cell(context, cell, map.stress[at], map.modes[at], range); });
  cairo_restore(context);
  axes.draw_frame(context);
  draw_bar(context, area, map, range, levels);
  draw_note(context, area.x + area.width, area.y + area.height + Axes::kBelow + 10.0, note_width, map.note);
}

}  // namespace cellcrush::client
