#include "results/curve_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "command_error.h"
#include "terminal/number_text.h"

namespace cellcrush::client {
namespace {

constexpr int kPoints = 1000;                 // of the common strain
constexpr double kFall = 0.05;                // of a peak, after it
constexpr double kLeastPeak = 0.5;            // of the mean stress: a smaller one is a wave or noise
constexpr StrainRange kIsoPlateau{0.2, 0.4};  // ISO 13314

std::vector<double> points_of(const StrainRange& range) {
  std::vector<double> out;
  for (int i = 0; i <= kPoints; ++i) out.push_back(range.from + (range.to - range.from) * i / kPoints);
  return out;
}

// Mean over a range by the trapezoidal rule.
double mean_over(const StressCurve& curve, const StrainRange& range) {
  double sum = 0.0;
  const auto points = points_of(range);
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += curve.at(points[i]) * (i == 0 || i + 1 == points.size() ? 0.5 : 1.0);
  return sum / kPoints;
}

// Index of the first peak of at least `least`; nothing if the stress never falls by kFall of the greatest before.
std::optional<std::size_t> find_peak(const StressCurve& curve, double end, double least) {
  std::size_t highest = 0;
  for (std::size_t i = 0; i < curve.strain.size() && curve.strain[i] <= end; ++i) {
    if (curve.stress_mpa[i] > curve.stress_mpa[highest]) highest = i;
    if (curve.stress_mpa[highest] >= least && curve.stress_mpa[i] < (1.0 - kFall) * curve.stress_mpa[highest])
      return highest;
  }
  return std::nullopt;
}

// Least squares through the points whose stress lies between 20 and 60 % of the peak, on the way to it.
std::optional<double> slope_to(const StressCurve& curve, std::size_t peak) {
  double count = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i <= peak; ++i) {
    const double stress = curve.stress_mpa[i];
    if (stress > 0.6 * curve.stress_mpa[peak]) break;
    if (stress < 0.2 * curve.stress_mpa[peak]) continue;
    count += 1.0;
    x += curve.strain[i];
    y += stress;
    xx += curve.strain[i] * curve.strain[i];
    xy += curve.strain[i] * stress;
  }
  const double spread = count * xx - x * x;
  if (count < 2.0 || spread <= 0.0) return std::nullopt;
  return (count * xy - x * y) / spread;
}

CurveNumbers numbers_of(const StressCurve& curve, const StrainRange& common, const StrainRange& window) {
  CurveNumbers out;
  const double mean = mean_over(curve, common);
  if (const auto peak = find_peak(curve, common.to, kLeastPeak * std::abs(mean))) {
    out.peak_mpa = curve.stress_mpa[*peak];
    out.peak_strain = curve.strain[*peak];
    out.slope_mpa = slope_to(curve, *peak);
  } else {
    const auto highest = std::ranges::max_element(curve.stress_mpa) - curve.stress_mpa.begin();
    out.slope_mpa = slope_to(curve, static_cast<std::size_t>(highest));
  }
  if (window.from >= common.from && window.to <= common.to) out.mean_mpa = mean_over(curve, window);
  out.energy_mj_per_mm3 = mean * (common.to - common.from);
  return out;
}

std::string names_of(const std::vector<Measurement>& measured) {
  std::string out;
  for (const auto& each : measured) out += (out.empty() ? "" : ", ") + each.name;
  return out;
}

struct ComparedRow {
  std::string quantity;
  std::string key;
  std::optional<double> measured;
  std::optional<double> computed;
};

std::vector<ComparedRow> rows_of(const CurveDifference& of) {
  return {{"elastic slope, MPa", "slope_mpa", of.measured.slope_mpa, of.computed.slope_mpa},
          {"first peak, MPa", "peak_mpa", of.measured.peak_mpa, of.computed.peak_mpa},
          {"strain of the first peak", "peak_strain", of.measured.peak_strain, of.computed.peak_strain},
          {fmt::format("mean from {:.3g} to {:.3g}, MPa", of.window.from, of.window.to), "mean_mpa",
           of.measured.mean_mpa, of.computed.mean_mpa},
          {fmt::format("energy to {:.3g}, mJ/mm3", of.common.to), "energy_mj_per_mm3", of.measured.energy_mj_per_mm3,
           of.computed.energy_mj_per_mm3}};
}

}  // namespace

CurveDifference compare_curves(const StressCurve& computed, const std::vector<Measurement>& measured,
                               const std::optional<StrainRange>& window) {
  CurveDifference out;
  out.common = {computed.strain.front(), computed.strain.back()};
  for (const auto& each : measured) {
    const StrainRange own{each.curve.strain.front(), each.curve.strain.back()};
    if (own.from >= out.common.to || own.to <= out.common.from) {
      refuse(
          fmt::format("{}: its strain goes from {:.3g} to {:.3g}, that of the other curves from {:.3g} to {:.3g}: "
                      "they do not overlap. Look at the units, or compare with a job of another end_strain",
                      each.name, own.from, own.to, out.common.from, out.common.to));
    }
    out.common = {std::max(out.common.from, own.from), std::min(out.common.to, own.to)};
  }
  out.window = window.value_or(kIsoPlateau);
  out.strain = points_of(out.common);
  StressCurve mean;
  double squares = 0.0;
  for (const double strain : out.strain) {
    double sum = 0.0;
    double least = INFINITY;
    double most = -INFINITY;
    for (const auto& each : measured) {
      const double stress = each.curve.at(strain);
      sum += stress;
      least = std::min(least, stress);
      most = std::max(most, stress);
    }
    out.mean_mpa.push_back(sum / static_cast<double>(measured.size()));
    out.least_mpa.push_back(least);
    out.most_mpa.push_back(most);
    const double difference = computed.at(strain) - out.mean_mpa.back();
    squares += difference * difference;
    if (std::abs(difference) > std::abs(out.greatest_mpa)) {
      out.greatest_mpa = difference;
      out.greatest_strain = strain;
    }
  }
  out.rms_mpa = std::sqrt(squares / static_cast<double>(out.strain.size()));
  mean.strain = out.strain;
  mean.stress_mpa = out.mean_mpa;
  // A single test keeps its own points, which a mean over a grid would smooth.
  out.measured = numbers_of(measured.size() == 1 ? measured.front().curve : mean, out.common, out.window);
  out.computed = numbers_of(computed, out.common, out.window);
  return out;
}

std::string difference_table(const CurveDifference& difference, const std::vector<Measurement>& measured) {
  std::string out =
      fmt::format("against {}, from strain {:.3g} to {:.3g}\n\n{:<30}{:>10}{:>10}{:>12}\n", names_of(measured),
                  difference.common.from, difference.common.to, "", "measured", "computed", "difference");
  const auto text = [](const std::optional<double>& value) { return value ? number_text(*value) : "-"; };
  for (const ComparedRow& row : rows_of(difference)) {
    const bool has_both = row.measured && row.computed && *row.measured != 0.0;
    out += fmt::format("{:<30}{:>10}{:>10}{:>12}\n", row.quantity, text(row.measured), text(row.computed),
                       has_both ? fmt::format("{:+.1f} %", 100.0 * (*row.computed / *row.measured - 1.0)) : "-");
  }
  out += fmt::format("{:<30}{:>10}{:>10}{:>12}\n", "greatest difference, MPa", "", "",
                     number_text(difference.greatest_mpa) + " at " + number_text(difference.greatest_strain));
  out += fmt::format("{:<30}{:>10}{:>10}{:>12}\n", "rms difference, MPa", "", "", number_text(difference.rms_mpa));
  return out;
}

std::string difference_json(const std::string& job, const CurveDifference& difference,
                            const std::vector<Measurement>& measured) {
  using nlohmann::json;
  json out;
  out["job"] = job;
  for (const auto& each : measured) out["tests"].push_back(each.name);
  out["strain_from"] = difference.common.from;
  out["strain_to"] = difference.common.to;
  out["window_from"] = difference.window.from;
  out["window_to"] = difference.window.to;
  for (const ComparedRow& row : rows_of(difference)) {
    if (row.measured) out["measured"][row.key] = *row.measured;
    if (row.computed) out["computed"][row.key] = *row.computed;
  }
  out["greatest_difference_mpa"] = difference.greatest_mpa;
  out["greatest_difference_strain"] = difference.greatest_strain;
  out["rms_difference_mpa"] = difference.rms_mpa;
  return out.dump();
}

}  // namespace cellcrush::client
