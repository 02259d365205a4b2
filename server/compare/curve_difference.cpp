#include "compare/curve_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.h"

namespace cellcrush::compare {
namespace {

constexpr int kPoints = 1000;                // of the common range
constexpr double kFall = 0.05;               // of a peak, after it
constexpr double kLeastPeak = 0.5;           // of the mean: a smaller one is a wave or noise
constexpr CurveRange kIsoPlateau{0.2, 0.4};  // ISO 13314

std::vector<double> points_of(const CurveRange& range) {
  std::vector<double> out;
  for (int i = 0; i <= kPoints; ++i) out.push_back(range.from + (range.to - range.from) * i / kPoints);
  return out;
}

// Mean over a range by the trapezoidal rule.
double mean_over(const LoadCurve& curve, const CurveRange& range) {
  double sum = 0.0;
  const auto points = points_of(range);
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += curve.at(points[i]) * (i == 0 || i + 1 == points.size() ? 0.5 : 1.0);
  return sum / kPoints;
}

// Index of the first peak of at least `least`; nothing if the curve never falls by kFall of the greatest before.
std::optional<std::size_t> find_peak(const LoadCurve& curve, double end, double least) {
  std::size_t highest = 0;
  for (std::size_t i = 0; i < curve.x.size() && curve.x[i] <= end; ++i) {
    if (curve.y[i] > curve.y[highest]) highest = i;
    if (curve.y[highest] >= least && curve.y[i] < (1.0 - kFall) * curve.y[highest]) return highest;
  }
  return std::nullopt;
}

// Least squares through the points between 20 and 60 % of the peak, on the way to it.
std::optional<double> slope_to(const LoadCurve& curve, std::size_t peak) {
  double count = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i <= peak; ++i) {
    const double stress = curve.y[i];
    if (stress > 0.6 * curve.y[peak]) break;
    if (stress < 0.2 * curve.y[peak]) continue;
    count += 1.0;
    x += curve.x[i];
    y += stress;
    xx += curve.x[i] * curve.x[i];
    xy += curve.x[i] * stress;
  }
  const double spread = count * xx - x * x;
  if (count < 2.0 || spread <= 0.0) return std::nullopt;
  return (count * xy - x * y) / spread;
}

// Index of the point that lies farthest above the line to the highest one: a curve without a peak bends there.
std::size_t find_knee(const LoadCurve& curve, std::size_t highest) {
  constexpr double kLeast = 0.1;  // of the height: less is a straight line
  std::size_t knee = highest;
  double farthest = kLeast * curve.y[highest];
  for (std::size_t i = 0; i < highest; ++i) {
    const double share = (curve.x[i] - curve.x.front()) / (curve.x[highest] - curve.x.front());
    const double above = curve.y[i] - share * curve.y[highest];
    if (above <= farthest) continue;
    farthest = above;
    knee = i;
  }
  return knee;
}

CurveNumbers numbers_of(const LoadCurve& curve, const CurveDifference& of) {
  CurveNumbers out;
  const double mean = mean_over(curve, of.common);
  if (const auto peak = find_peak(curve, of.common.to, kLeastPeak * std::abs(mean))) {
    out.peak = curve.y[*peak];
    out.peak_at = curve.x[*peak];
    out.slope = slope_to(curve, *peak);
  } else {
    const auto end = std::ranges::upper_bound(curve.x, of.common.to) - curve.x.begin();
    const auto highest =
        static_cast<std::size_t>(std::max_element(curve.y.begin(), curve.y.begin() + end) - curve.y.begin());
    out.slope = slope_to(curve, find_knee(curve, highest));
  }
  if (of.window.from >= of.common.from && of.window.to <= of.common.to) out.mean = mean_over(curve, of.window);
  out.energy = mean_over(curve, {of.common.from, of.energy_to}) * (of.energy_to - of.common.from);
  return out;
}

const char* name_of(CurveKind kind) { return kind == CurveKind::stress_strain ? "strain" : "displacement"; }

const char* unit_of(CurveKind kind) { return kind == CurveKind::stress_strain ? "" : " mm"; }

}  // namespace

CurveDifference compare_curves(CurveKind kind, const LoadCurve& computed, const std::vector<Measurement>& measured,
                               const ComparedRanges& ranges) {
  CurveDifference out;
  out.kind = kind;
  out.common = {computed.x.front(), computed.x.back()};
  for (const auto& each : measured) {
    const CurveRange own{each.curve.x.front(), each.curve.x.back()};
    if (own.from >= out.common.to || own.to <= out.common.from) {
      throw InvalidField(
          "tests",
          fmt::format("has {}, whose {} goes from {:.3g} to {:.3g}{}, that of the other curves from {:.3g} "
                      "to {:.3g}{}: they do not overlap.",
                      each.name, name_of(kind), own.from, own.to, unit_of(kind), out.common.from, out.common.to,
                      unit_of(kind)),
          "Look at the units, or compare with a job that goes as far.");
    }
    out.common = {std::max(out.common.from, own.from), std::min(out.common.to, own.to)};
  }
  out.window = ranges.window.value_or(kind == CurveKind::stress_strain ? kIsoPlateau : out.common);
  out.energy_to = ranges.energy_to.value_or(out.common.to);
  if (!(out.energy_to > out.common.from && out.energy_to <= out.common.to)) {
    throw InvalidField("energy_to",
                       fmt::format("is {:.4g}{}; all curves go from {:.4g} to {:.4g}{}.", out.energy_to, unit_of(kind),
                                   out.common.from, out.common.to, unit_of(kind)),
                       fmt::format("Give a {} between.", name_of(kind)));
  }
  out.x = points_of(out.common);
  double squares = 0.0;
  for (const double at : out.x) {
    double sum = 0.0;
    double least = INFINITY;
    double most = -INFINITY;
    for (const auto& each : measured) {
      const double value = each.curve.at(at);
      sum += value;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    out.mean.push_back(sum / static_cast<double>(measured.size()));
    out.least.push_back(least);
    out.most.push_back(most);
    out.computed_y.push_back(computed.at(at));
    const double difference = out.computed_y.back() - out.mean.back();
    squares += difference * difference;
    if (std::abs(difference) > std::abs(out.greatest)) {
      out.greatest = difference;
      out.greatest_at = at;
    }
  }
  out.rms = std::sqrt(squares / static_cast<double>(out.x.size()));
  // A single test keeps its own points, which a mean over a grid would smooth.
  out.measured = numbers_of(measured.size() == 1 ? measured.front().curve : LoadCurve{out.x, out.mean}, out);
  out.computed = numbers_of(computed, out);
  return out;
}

}  // namespace cellcrush::compare
