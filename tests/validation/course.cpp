#include "validation/course.h"

#include <algorithm>

#include "measure/curve.h"
#include "measure/lasting_rise.h"

namespace cellcrush::validation {
namespace {

struct Point {
  double strain = 0.0;
  double stress = 0.0;
};

/// The smoothed curve at the samples' strains from the first full window on. Near the end the window is cut, so that no
/// stress of beyond it is needed.
std::vector<Point> smooth(std::span<const Sample> samples, const Curve& curve, double last) {
  std::vector<Point> points;
  for (const Sample& sample : samples) {
    const double low = sample.strain - 0.5 * kPeakSmoothing;
    const double high = std::min(samples.back().strain, sample.strain + 0.5 * kPeakSmoothing);
    if (low >= 0.0 && high > low && sample.strain <= last) {
      points.push_back({sample.strain, (curve.integral(high) - curve.integral(low)) / (high - low)});
    }
  }
  return points;
}

/// The least stress from point `top` up to where the curve rises above it, going by `step`; none rises higher: up to
/// the end.
double valley(const std::vector<Point>& points, std::size_t top, int step) {
  double least = points[top].stress;
  for (std::size_t i = top; i < points.size() && points[i].stress <= points[top].stress; i += step) {
    least = std::min(least, points[i].stress);
  }
  return least;
}

/// The last sample at which the smoothed stress is no more than twice the mean up to it; the last of all where none is.
const Sample& last_below_twice_the_mean(std::span<const Sample> samples, const Curve& curve) {
  constexpr double kHalf = 0.5 * Curve::kSmoothing;
  const Sample* found = &samples.back();
  for (const Sample& sample : samples) {
    if (sample.strain >= kHalf && sample.strain + kHalf <= curve.end() &&
        curve.smoothed(sample.strain) <= 2.0 * curve.integral(sample.strain) / sample.strain) {
      found = &sample;
    }
  }
  return *found;
}

}  // namespace

std::vector<Peak> find_salient_peaks(std::span<const Sample> samples, double last) {
  const Curve curve(samples, &Sample::stress_impact);
  const std::vector<Point> points = smooth(samples, curve, last);
  const double plateau = curve.integral(last) / last;
  std::vector<Peak> peaks;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point& point = points[i];
    if (point.stress <= points[i - 1].stress || point.stress < points[i + 1].stress) {
      continue;
    }
    const double prominence = point.stress - std::max(valley(points, i, -1), valley(points, i, 1));
    if (prominence >= kSalient * plateau) {
      peaks.push_back({point.strain, point.stress, prominence});
    }
  }
  return peaks;
}

Course find_course(std::span<const Sample> samples) {
  const Curve curve(samples, &Sample::stress_impact);
  const Sample& last = samples.back();
  const auto onset = find_onset(curve_of_both_plates(samples));
  Course course;
  course.densified = onset.has_value();
  course.densification = onset.value_or(last.strain);
  course.densification_travel = course.densification * last.travel / last.strain;
  const Sample& rise = last_below_twice_the_mean(samples, curve);
  course.risen = rise.strain + Curve::kSmoothing < last.strain;
  course.rise_travel = course.risen ? rise.travel : last.travel;
  course.plateau = curve.integral(course.densification) / course.densification;
  course.peaks =
      find_salient_peaks(samples, std::max(course.densification, course.rise_travel * last.strain / last.travel));
  return course;
}

}  // namespace cellcrush::validation
