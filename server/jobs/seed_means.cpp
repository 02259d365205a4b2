#include "jobs/seed_means.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "cellcrush/convergence.h"
#include "columns/result_columns.h"
#include "columns/swept_fields.h"

namespace cellcrush::jobs {

SeedMeans::SeedMeans(const v1::Sweep& sweep) {
  const auto fields = swept_fields(sweep);
  const auto seed = std::ranges::find(fields, kSeedField);
  if (seed != fields.end()) seed_ = static_cast<std::size_t>(seed - fields.begin());
}

void SeedMeans::add(const v1::SweepTable::Row& row) {
  std::vector<double> others(row.values().begin(), row.values().end());
  if (*seed_ < others.size()) others.erase(others.begin() + static_cast<std::ptrdiff_t>(*seed_));
  const auto [place, is_new] = places_.try_emplace(others, points_.size());
  if (is_new) {
    auto& point = points_.emplace_back();
    point.counts.mutable_values()->Add(others.begin(), others.end());
    point.results.resize(result_columns().size());
  }
  auto& [counts, results, modes] = points_[place->second];
  const v1::Summary& summary = row.result().summary();
  counts.set_job_count(counts.job_count() + 1);
  if (row.result().state() == v1::Job::FAILED) counts.set_failed_count(counts.failed_count() + 1);
  if (row.result().state() != v1::Job::SUCCEEDED) return;
  counts.set_succeeded_count(counts.succeeded_count() + 1);
  if (!summary.warnings().empty()) counts.set_warned_count(counts.warned_count() + 1);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (const auto value = find_result(summary, result_columns()[i].path)) results[i].push_back(*value);
  }
  if (summary.crush_mode() != v1::Summary::CRUSH_MODE_UNSPECIFIED) ++modes[summary.crush_mode()];
}

v1::SweepTable::SeedMeans SeedMeans::means(std::size_t point) const {
  auto out = points_[point].counts;
  for (std::size_t i = 0; i < points_[point].results.size(); ++i) {
    const auto& values = points_[point].results[i];
    if (values.empty()) continue;
    const SeedStatistics of = statistics_of(values);
    auto& result = *out.add_results();
    result.set_field(result_columns()[i].path);
    result.set_job_count(of.count);
    result.set_mean(of.mean);
    if (of.count < 2) continue;
    result.set_deviation(of.deviation);
    result.set_interval(interval_of_difference(of, {}));
  }
  std::vector<std::pair<v1::Summary::CrushMode, int>> modes(points_[point].modes.begin(), points_[point].modes.end());
  std::ranges::stable_sort(modes, std::greater(), &std::pair<v1::Summary::CrushMode, int>::second);
  for (const auto& [mode, count] : modes) {
    auto& counted = *out.add_crush_modes();
    counted.set_mode(mode);
    counted.set_job_count(count);
  }
  return out;
}

}  // namespace cellcrush::jobs
