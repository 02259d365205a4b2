#include "plots/job_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "chart/colour_map.h"
#include "chart/smoothing.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

namespace {

constexpr double kSmoothingWindow = 0.02;
struct PlateCurves {
  std::vector<double> strain;
  std::vector<double> impact;
  std::vector<double> support;
};

PlateCurves curves_of(const JobHistory& history) {
  PlateCurves curves;
  for (const v1::Sample& sample : history.samples) {
    if (!std::isfinite(sample.strain() + sample.stress_impact_mpa() + sample.stress_support_mpa())) continue;
    curves.strain.push_back(sample.strain());
    curves.impact.push_back(sample.stress_impact_mpa());
    curves.support.push_back(sample.stress_support_mpa());
  }
  return curves;
}

PlateCurves smoothed(const PlateCurves& raw) {
  return {raw.strain, running_mean(raw.strain, raw.impact, kSmoothingWindow),
          running_mean(raw.strain, raw.support, kSmoothingWindow)};
}

double last_strain(const PlateCurves& curves) { return curves.strain.empty() ? 0.0 : curves.strain.back(); }

// The upper end of the stress axis. It follows the plateau: neither the first wave, which is far higher in a fast
// crush, nor the stress after densification.
double find_top(const JobHistory& history, const PlateCurves& smooth) {
  constexpr double kFirstWave = 0.1;
  const v1::Summary& summary = history.job.summary();
  const double solid = summary.has_densification_strain() ? summary.densification_strain() : 0.65;
  std::vector<double> crushing;
  for (std::size_t i = 0; i < smooth.strain.size(); ++i) {
    const bool first_wave = smooth.strain[i] < kFirstWave && last_strain(smooth) > 2.0 * kFirstWave;
    if (smooth.strain[i] <= solid && !first_wave) crushing.push_back(std::max(smooth.impact[i], smooth.support[i]));
  }
  double top = crushing.empty() ? 0.0 : 1.3 * quantile(crushing, 0.95);
  if (history.job.words().theory_note().empty()) top = std::max(top, 1.2 * summary.theory().shock_mpa());
  top = std::max({top, 1.6 * summary.plateau_stress_impact_mpa(), 1.6 * summary.plateau_stress_support_mpa()});
  return top > 0.0 ? top : 1.0;
}

// An arrow where the smoothed stress of a plate most exceeds the chart.
void add_overshoot(Chart& chart, const std::vector<double>& strain, const std::vector<double>& stress, Colour colour) {
  const auto peak = std::max_element(stress.begin(), stress.end());
  if (peak == stress.end() || *peak <= 1.001 * chart.y.high) return;
  chart.overshoots.push_back(
      {strain[static_cast<std::size_t>(peak - stress.begin())], number_text(*peak, 2) + " MPa", colour});
}

double highest(const PlateCurves& curves) {
  double value = 0.0;
  for (const double stress : curves.impact) value = std::max(value, stress);
  for (const double stress : curves.support) value = std::max(value, stress);
  return value;
}

Chart empty_chart(double strain, double top, double peak) {
  Chart chart;
  chart.x = {0.0, std::max(strain, 0.01), "nominal strain"};
  chart.y = {0.0, top, "nominal stress (MPa)"};
  chart.note = fmt::format("moving mean over {:.0f} % strain", 100 * kSmoothingWindow);
  if (peak > 1.001 * top)
    chart.note += fmt::format("; single samples reach {} MPa, off the chart", number_text(peak, 2));
  return chart;
}

std::string with_plateau(const char* plate, bool known, double stress) {
  return known ? fmt::format("{}: plateau {} MPa", plate, number_text(stress)) : plate;
}

std::string theory_name(const char* theory, double stress, const Chart& chart) {
  return fmt::format("{}: {} MPa{}", theory, number_text(stress), stress > chart.y.high ? ", beyond the chart" : "");
}

}  // namespace

std::string picture_name(const v1::Job& job) {
  const std::string& title = job.case_().title();
  std::string name = title.empty() ? job.name() : title;
  if (!job.case_().loading().has_speed_m_per_s()) return name;
  const std::string speed = fmt::format("{} m/s", job.case_().loading().speed_m_per_s());
  return name.find(speed) == std::string::npos ? name + ", " + speed : name;
}

Chart build_job_chart(const JobHistory& history) {
  const PlateCurves raw = curves_of(history);
  const PlateCurves smooth = smoothed(raw);
  const v1::Summary& summary = history.job.summary();
  Chart chart = empty_chart(last_strain(raw), find_top(history, smooth), highest(raw));
  chart.note += "; thin: every sample";
  struct Plate {
    const char* name;
    const std::vector<double>& raw;
    const std::vector<double>& smooth;
    Colour colour;
    bool has_plateau;
    double plateau;
  };
  const Plate plates[] = {{"impact plate", raw.impact, smooth.impact, kImpactColour,
                           summary.has_plateau_stress_impact_mpa(), summary.plateau_stress_impact_mpa()},
                          {"support plate", raw.support, smooth.support, kSupportColour,
                           summary.has_plateau_stress_support_mpa(), summary.plateau_stress_support_mpa()}};
  for (const Plate& plate : plates) {
    Colour faint = plate.colour;
    faint.opacity = 0.28;
    chart.curves.push_back({raw.strain, plate.raw, {faint, 0.7, {}}, ""});
  }
  for (const Plate& plate : plates) {
    chart.curves.push_back({smooth.strain,
                            plate.smooth,
                            {plate.colour, 2.0, {}},
                            with_plateau(plate.name, plate.has_plateau, plate.plateau)});
    add_overshoot(chart, smooth.strain, plate.smooth, plate.colour);
  }
  const double low = summary.plateau_window_low();
  const double high = summary.plateau_window_high();
  if (high > low) {
    chart.bands.push_back({low, high, "plateau window"});
    for (const Plate& plate : plates) {
      if (plate.has_plateau) chart.curves.push_back(level_curve(plate.plateau, low, high, {kInk, 1.8, {}}, ""));
    }
  }
  if (summary.theory().shock_mpa() > 0.0) {
    const auto add_theory = [&](const char* name, double stress, std::vector<double> dashes) {
      chart.curves.push_back(level_curve(stress, 0.0, chart.x.high, {kMutedInk, 1.4, std::move(dashes)},
                                         theory_name(name, stress, chart)));
    };
    add_theory("shock theory (Eq. 51)", summary.theory().shock_mpa(), {8.0, 4.0});
    if (summary.has_front())
      add_theory("shock theory, measured jumps (Eq. 52)", summary.front().shock_mpa(), {10.0, 3.0, 2.0, 3.0});
    add_theory("quasi-static theory (Gibson-Ashby)", summary.theory().gibson_ashby_mpa(), {2.0, 3.0});
  }
  return chart;
}

Chart build_comparison_chart(const std::vector<JobHistory>& histories) {
  std::map<std::string, int> uses;
  for (const JobHistory& history : histories) ++uses[picture_name(history.job)];
  std::vector<Curve> curves;
  double strain = 0.0;
  double top = 0.0;
  double peak = 0.0;
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const v1::Job& job = histories[i].job;
    const PlateCurves smooth = smoothed(curves_of(histories[i]));
    const Colour colour = kSeriesColours[i % kSeriesColours.size()];
    std::string name = picture_name(job);
    if (uses[name] > 1) name += " (" + job.name() + ")";
    if (job.summary().has_plateau_stress_impact_mpa()) {
      name += fmt::format(": plateau {} MPa", number_text(job.summary().plateau_stress_impact_mpa()));
    }
    curves.push_back({smooth.strain, smooth.impact, {colour, 2.0, {}}, name});
    LineStyle dashed{colour, 1.4, {}};
    dashed.dashes = {5.0, 3.0};
    curves.push_back({smooth.strain, smooth.support, dashed, ""});
    strain = std::max(strain, last_strain(smooth));
    top = std::max(top, find_top(histories[i], smooth));
    peak = std::max(peak, highest(smooth));
  }
  Chart chart = empty_chart(strain, top, peak);
  for (const Curve& curve : curves) add_overshoot(chart, curve.x, curve.y, curve.style.colour);
  chart.note += "; solid: impact plate, dashed: support plate";
  chart.curves = std::move(curves);
  return chart;
}

}  // namespace cellcrush::client
