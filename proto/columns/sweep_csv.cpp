#include "columns/sweep_csv.h"

#include <cstdint>
#include <optional>

#include "columns/result_columns.h"

namespace cellcrush {

namespace {

using Means = v1::SweepTable::SeedMeans;

void add_heading(CsvText& text, const v1::SweepTable& table, bool has_means) {
  for (const std::string& field : table.fields()) text.add(field);
  for (const char* name : {"jobs", "succeeded", "failed"}) {
    if (has_means) text.add(name);
  }
  for (const char* name : {"job", "state"}) {
    if (!has_means) text.add(name);
  }
  for (std::size_t i = 0; i < result_columns().size(); ++i) {
    if (i == kColumnsBeforeMode) text.add("crush_mode");
    if (i == kColumnsBeforeMode && has_means) text.add("crush_mode_count");
    const std::string field = result_columns()[i].field();
    text.add(field);
    if (!has_means) continue;
    text.add(field + "_ci95");
    text.add(field + "_count");
  }
  text.end_row();
}

void add_spread(CsvText& text, const Means& means, const ResultColumn& column) {
  const auto* mean = find_mean(means, column.path);
  const bool has_interval = mean != nullptr && mean->has_interval();
  text.add(has_interval ? std::optional(mean->interval()) : std::nullopt);
  text.add(std::int64_t{mean == nullptr ? 0 : mean->job_count()});
}

void add_crush_mode(CsvText& text, const v1::Summary& summary, const Means* means) {
  text.add(crush_mode_code(summary.crush_mode()));
  if (means != nullptr) text.add(std::int64_t{means->crush_modes().empty() ? 0 : means->crush_modes(0).job_count()});
}

}  // namespace

std::string sweep_table_csv(const v1::SweepTable& table, Decimal decimal) {
  const bool has_means = !table.means().empty();
  CsvText text(decimal);
  add_heading(text, table, has_means);
  for (int i = 0; i < table.rows_size(); ++i) {
    const auto& row = table.rows(i);
    const Means* means = has_means ? &table.means(i) : nullptr;
    for (int k = 0; k < table.fields_size(); ++k)
      text.add(k < row.values_size() ? std::optional(row.values(k)) : std::nullopt);
    if (means != nullptr) {
      for (const int count : {means->job_count(), means->succeeded_count(), means->failed_count()})
        text.add(std::int64_t{count});
    } else {
      text.add(row.job());
      text.add(v1::Job::State_Name(row.result().state()));
    }
    for (std::size_t k = 0; k < result_columns().size(); ++k) {
      if (k == kColumnsBeforeMode) add_crush_mode(text, row.result().summary(), means);
      text.add(result_of(table, i, result_columns()[k]));
      if (means != nullptr) add_spread(text, *means, result_columns()[k]);
    }
    text.end_row();
  }
  return text.take();
}

}  // namespace cellcrush
