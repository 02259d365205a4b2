#include "validation/charts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include "bench/csv_table.h"
#include "cellcrush/fidelity.h"
#include "chart/colour_map.h"
#include "chart/smoothing.h"
#include "validation/course.h"
#include "validation/options.h"

namespace cellcrush::validation {
namespace {

using client::Chart;
using client::Curve;
using client::Marker;

constexpr double kRoom = 3.0;  // stresses shown, over the highest plateau: what is crushed solid leaves the chart

double along_at(const Sample& last, double strain, double Sample::*along) {
  return strain * (last.*along) / last.strain;
}

Curve line_of(const NamedCurve& named, double Sample::*along, const client::Colour& colour) {
  std::vector<double> strain;
  std::vector<double> stress;
  Curve line{{}, {}, {colour, 1.6, {}}, named.name};
  for (const Sample& sample : named.samples) {
    strain.push_back(sample.strain);
    stress.push_back(sample.stress_impact);
    line.x.push_back(sample.*along);
  }
  line.y = client::running_mean(strain, stress, kPeakSmoothing);
  return line;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Options that may differ among crushes that one chart shows; the mesh is asked for.
const std::set<std::string> kOfSeeds = {"speed",     "end_strain", "samples", "frame_count",
                                        "amplitude", "seed",       "elements"};

bool is_of_seeds(const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return kOfSeeds.contains(word.substr(0, word.find('='))); });
}

std::vector<double> take(const std::vector<Plateau>& plateaus, double Plateau::*field) {
  std::vector<double> values;
  std::transform(plateaus.begin(), plateaus.end(), std::back_inserter(values),
                 [&](const Plateau& plateau) { return plateau.*field; });
  return values;
}

Chart empty_chart(double fastest, double highest) {
  Chart chart;
  chart.x = {0.0, 1.05 * fastest, "speed of the impact plate (m/s)"};
  chart.y = {0.0, 1.1 * highest, "plateau stress (MPa)"};
  chart.note = "means over strains of 0.20 to 0.40";
  return chart;
}

std::string fit_text(const std::string& preset, const client::QuadraticFit& fit) {
  char text[96];
  std::snprintf(text, sizeof(text), ": %.2f %+.4f V %+.6f V\u00b2", fit.constant, fit.linear, fit.quadratic);
  return preset + text;
}

}  // namespace

client::Chart crush_chart(const std::vector<NamedCurve>& curves, double Sample::*along) {
  client::Chart chart;
  chart.x.high = 0.0;
  chart.x.label = along == &Sample::strain ? "nominal strain" : "travel of the impact plate (mm)";
  chart.y = {0.0, 0.0, "nominal stress (MPa)"};
  chart.note = "mean over 1 % strain; discs: salient peaks, squares: onset of densification";
  for (const NamedCurve& named : curves) {
    const client::Colour colour = client::kSeriesColours[chart.curves.size() / 3 % client::kSeriesColours.size()];
    const Sample& last = named.samples.back();
    const Course course = find_course(named.samples);
    chart.curves.push_back(line_of(named, along, colour));
    Curve peaks{{}, {}, {colour, 0.0, {}}, "", Marker::disc};
    for (const Peak& peak : course.peaks) {
      peaks.x.push_back(along_at(last, peak.strain, along));
      peaks.y.push_back(peak.stress);
      chart.y.high = std::max(chart.y.high, 1.15 * peak.stress);
    }
    chart.curves.push_back(std::move(peaks));
    Curve onset{{}, {}, {colour, 0.0, {}}, "", Marker::square};
    if (course.densified) {
      onset.x.push_back(along_at(last, course.densification, along));
      const auto& line = chart.curves[chart.curves.size() - 2];
      const auto after = std::lower_bound(line.x.begin(), line.x.end(), onset.x.back()) - line.x.begin();
      onset.y.push_back(line.y[std::min<std::size_t>(after, line.y.size() - 1)]);
    }
    chart.curves.push_back(std::move(onset));
    chart.x.high = std::max(chart.x.high, last.*along);
    chart.y.high = std::max(chart.y.high, kRoom * course.plateau);
  }
  return chart;
}

std::vector<Plateau> read_plateaus(const std::vector<std::string>& tables, const std::string& preset, int elements) {
  std::vector<Plateau> plateaus;
  for (const std::string& table : tables) {
    for (const bench::CsvRow& row : bench::read_csv(table)) {
      std::vector<std::string> words = words_of(row.at("options"));
      const double impact = bench::number_in(row, "plateau_stress_impact");
      if (row.at("preset") != preset || !is_of_seeds(words) || !std::isfinite(impact)) continue;
      words.insert(words.begin(), preset);
      const SceneSpec spec = fill_in_fidelity(read_options(words).spec);
      if (*spec.elements_per_wall != elements) continue;
      plateaus.push_back({preset, *spec.loading.speed_m_per_s, impact, bench::number_in(row, "plateau_stress_support"),
                          bench::number_in(row, "theory_shock"), bench::number_in(row, "front_shock")});
    }
  }
  if (plateaus.empty()) {
    throw std::invalid_argument(preset + " with " + std::to_string(elements) +
                                " elements per wall: stands in none of the tables with a plateau; give tables that "
                                "have it.");
  }
  std::ranges::stable_sort(plateaus, {}, &Plateau::speed);
  return plateaus;
}

Chart theory_chart(const std::vector<Plateau>& plateaus) {
  const std::vector<double> speed = take(plateaus, &Plateau::speed);
  const std::vector<double> shock = take(plateaus, &Plateau::shock);
  Chart chart = empty_chart(speed.back(), *std::max_element(shock.begin(), shock.end()));
  chart.curves = {
      {speed, shock, {client::kMutedInk, 1.4, {8.0, 4.0}}, "Eq. 51"},
      {speed, take(plateaus, &Plateau::front), {client::kInk, 1.4, {}}, "Eq. 52, jumps measured", Marker::cross},
      {speed, take(plateaus, &Plateau::impact), {client::kImpactColour, 0.0, {}}, "impact plate", Marker::disc},
      {speed, take(plateaus, &Plateau::support), {client::kSupportColour, 0.0, {}}, "support plate", Marker::square}};
  return chart;
}

Chart fit_chart(const std::vector<std::vector<Plateau>>& presets, double to_speed) {
  constexpr int kPoints = 100;
  double highest = 0.0;
  std::vector<Curve> curves;
  for (const std::vector<Plateau>& plateaus : presets) {
    const client::Colour colour = client::kSeriesColours[curves.size() / 2 % client::kSeriesColours.size()];
    const std::vector<double> speed = take(plateaus, &Plateau::speed);
    const std::vector<double> impact = take(plateaus, &Plateau::impact);
    const auto fit = client::find_quadratic_fit(speed, impact);
    Curve line{{}, {}, {colour, 1.5, {}}, fit ? fit_text(plateaus.front().preset, *fit) : ""};
    for (int i = 0; fit && i <= kPoints; ++i) {
      line.x.push_back(to_speed * i / kPoints);
      line.y.push_back(fit->at(line.x.back()));
    }
    curves.push_back(std::move(line));
    curves.push_back({speed, impact, {colour, 0.0, {}}, fit ? "" : plateaus.front().preset, Marker::disc});
    for (const Plateau& plateau : plateaus) {
      highest = plateau.speed <= to_speed ? std::max(highest, plateau.impact) : highest;
    }
  }
  Chart chart = empty_chart(to_speed, highest);
  chart.curves = std::move(curves);
  return chart;
}

}  // namespace cellcrush::validation
