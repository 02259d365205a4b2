#include "validation/crush_chart.h"

#include <algorithm>

#include "chart/palette.h"
#include "chart/smoothing.h"
#include "validation/course.h"

namespace cellcrush::validation {
namespace {

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

}  // namespace cellcrush::validation
