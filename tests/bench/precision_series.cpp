#include "bench/precision_series.h"

#include <algorithm>
#include <map>

namespace cellcrush::bench {
namespace {

constexpr double kPerCent = 100.0;
constexpr double kLeastError = 1e-6;

std::string group_of(const std::string& variant) { return variant.substr(0, variant.find(':')); }

PrecisionPoint point_of(const Precision& precision, const Measure& measure, const std::string& converged) {
  PrecisionPoint point;
  point.seconds = precision.seconds;
  point.error = kPerCent * std::max(claimed_error(precision), kLeastError);
  point.low = kPerCent * std::max(0.0, precision.error - precision.uncertainty);
  point.high = kPerCent * (precision.error + precision.uncertainty);
  point.is_bound = !measure.absolute && precision.error <= precision.uncertainty;
  point.on_front = precision.on_front;
  point.label = label_of(precision.variant);
  if (!measure.absolute && precision.variant == converged) point.label += " (reference)";
  return point;
}

}  // namespace

Family family_of(const std::string& variant) {
  static const std::map<std::string, Family> kFamilies = {{"default", Family::force_based},
                                                          {"elements", Family::force_based},
                                                          {"converged", Family::force_based},
                                                          {"displacement", Family::displacement_based},
                                                          {"paper", Family::papers}};
  const auto found = kFamilies.find(group_of(variant));
  return found == kFamilies.end() ? Family::other_setting : found->second;
}

std::string name_of(Family family) {
  switch (family) {
    case Family::force_based: return "force-based elements (default)";
    case Family::displacement_based: return "displacement-based elements";
    case Family::papers: return "the paper's elements";
    default: return "2 force-based, one other setting changed";
  }
}

std::string label_of(const std::string& variant) {
  static const std::map<std::string, std::string> kLabels = {{"default:2", "2 (default)"},
                                                             {"area:constant", "constant area"},
                                                             {"depth:lobatto", "Lobatto points"},
                                                             {"depth:4", "4 depth points"},
                                                             {"axial:3", "3 points along"},
                                                             {"axial:5", "5 points along"},
                                                             {"precision:double", "double"},
                                                             {"search:buckets", "buckets"},
                                                             {"rotary:3", "rotary inertia ×3"},
                                                             {"mass:4", "masses ×4"},
                                                             {"mass:16", "masses ×16"},
                                                             {"penalty:x4", "contact ×4"},
                                                             {"penalty:/4", "contact /4"},
                                                             {"step:.5", "step /2"},
                                                             {"step:.25", "step /4"}};
  const auto found = kLabels.find(variant);
  if (found != kLabels.end()) return found->second;
  const std::string label = variant.substr(variant.find(':') + 1);
  return family_of(variant) == Family::other_setting ? group_of(variant) + " " + label : label;
}

std::vector<PrecisionSeries> series_of(const std::vector<Precision>& all, const Measure& measure,
                                       const std::string& converged) {
  std::vector<PrecisionSeries> found;
  for (int family = 0; family < kFamilyCount; ++family) {
    PrecisionSeries series{static_cast<Family>(family), {}};
    for (const Precision& precision : all) {
      if (family_of(precision.variant) == series.family) {
        series.points.push_back(point_of(precision, measure, converged));
      }
    }
    std::sort(series.points.begin(), series.points.end(),
              [](const PrecisionPoint& one, const PrecisionPoint& other) { return one.seconds < other.seconds; });
    if (!series.points.empty()) found.push_back(std::move(series));
  }
  return found;
}

}  // namespace cellcrush::bench
