#include "bench/precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "validation/options.h"

namespace cellcrush::bench {
namespace {

/// Of the finished crushes of a variant.
struct Statistics {
  int count = 0;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard, of one crush
  double seconds = 0.0;    ///< mean

  [[nodiscard]] double variance_of_mean() const { return deviation * deviation / count; }
};

Statistics statistics_of(const VariedScene& scene, const Variant& variant, const std::vector<CsvRow>& rows,
                         const std::string& column) {
  std::vector<double> values;
  Statistics statistics;
  for (const CsvRow& row : rows) {
    if (!is_of(row, scene, variant) || row.at("status") != "finished") continue;
    if (const double value = number_in(row, column); std::isfinite(value)) {
      values.push_back(value);
      statistics.seconds += number_in(row, "processor_seconds");
    }
  }
  statistics.count = static_cast<int>(values.size());
  for (const double value : values) statistics.mean += value / statistics.count;
  for (const double value : values) {
    statistics.deviation += (value - statistics.mean) * (value - statistics.mean) / std::max(1, statistics.count - 1);
  }
  statistics.deviation = std::sqrt(statistics.deviation);
  statistics.seconds /= std::max(1, statistics.count);
  return statistics;
}

/// Half of a 95 % interval over its standard error, after Student: few seeds know their scatter badly.
double student_factor(int freedom) {
  constexpr std::array kFactors = {12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23};
  return freedom <= static_cast<int>(kFactors.size()) ? kFactors[freedom - 1] : 2.2;
}

void mark_front(std::vector<Precision>& all) {
  std::vector<Precision*> by_time;
  by_time.reserve(all.size());
  for (Precision& precision : all) by_time.push_back(&precision);
  std::sort(by_time.begin(), by_time.end(),
            [](const auto* one, const auto* other) { return one->seconds < other->seconds; });
  double least = std::numeric_limits<double>::infinity();
  for (Precision* precision : by_time) {
    precision->on_front = claimed_error(*precision) < least;
    least = std::min(least, claimed_error(*precision));
  }
}

}  // namespace

double claimed_error(const Precision& precision) { return std::max(precision.error, precision.uncertainty); }

bool is_of(const CsvRow& row, const VariedScene& scene, const Variant& variant) {
  const std::string seed = row.at("seed");
  return row.at("scene") == scene.name && row.at("variant") == variant.name &&
         row.at("options") == validation::read_options(words_of(scene, variant, std::stoi(seed))).changes;
}

std::vector<Precision> precisions(const VariedScene& scene, const std::vector<CsvRow>& rows, const Measure& measure,
                                  const std::string& converged, double& scatter) {
  Statistics reference;
  for (const Variant& variant : scene.variants) {
    if (variant.name == converged) reference = statistics_of(scene, variant, rows, measure.column);
  }
  if (reference.count < 2) {
    throw std::invalid_argument(scene.name + ": the table has no two seeds of " + converged +
                                "; run it, or name another converged variant.");
  }
  const double scale = measure.absolute ? 1.0 : std::abs(reference.mean);
  scatter = measure.absolute ? 0.0 : reference.deviation / scale;
  std::vector<Precision> all;
  for (const Variant& variant : scene.variants) {
    const Statistics found = statistics_of(scene, variant, rows, measure.column);
    if (found.count < 2) continue;
    const bool is_alone = measure.absolute || variant.name == converged;
    const double expected = measure.absolute ? 0.0 : reference.mean;
    const double variance = found.variance_of_mean() + (is_alone ? 0.0 : reference.variance_of_mean());
    const double factor = student_factor(found.count - 1 + (is_alone ? 0 : reference.count - 1));
    all.push_back({variant.name, found.seconds, std::abs(found.mean - expected) / scale,
                   factor * std::sqrt(variance) / scale, found.deviation / scale, found.count, false});
  }
  mark_front(all);
  return all;
}

}  // namespace cellcrush::bench
