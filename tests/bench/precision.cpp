#include "bench/precision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cellcrush/convergence.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

/// Of the finished crushes of a variant.
struct Statistics {
  SeedStatistics of;
  double seconds = 0.0;  ///< mean
};

Statistics statistics_in(const VariedScene& scene, const Variant& variant, const std::vector<CsvRow>& rows,
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
  statistics.of = statistics_of(values);
  statistics.seconds /= std::max(1, statistics.of.count);
  return statistics;
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
  SeedStatistics reference;
  for (const Variant& variant : scene.variants) {
    if (variant.name == converged) reference = statistics_in(scene, variant, rows, measure.column).of;
  }
  if (reference.count < 2) {
    throw std::invalid_argument(scene.name + ": the table has no two seeds of " + converged +
                                "; run it, or name another converged variant.");
  }
  const double scale = measure.absolute ? 1.0 : std::abs(reference.mean);
  scatter = measure.absolute ? 0.0 : reference.deviation / scale;
  std::vector<Precision> all;
  for (const Variant& variant : scene.variants) {
    const auto [found, seconds] = statistics_in(scene, variant, rows, measure.column);
    if (found.count < 2) continue;
    const bool is_alone = measure.absolute || variant.name == converged;
    const double expected = measure.absolute ? 0.0 : reference.mean;
    all.push_back({variant.name, seconds, std::abs(found.mean - expected) / scale,
                   interval_of_difference(found, is_alone ? SeedStatistics() : reference) / scale,
                   found.deviation / scale, found.count, false});
  }
  mark_front(all);
  return all;
}

}  // namespace cellcrush::bench
