#include "docs/tables/crush_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bench/precision.h"
#include "cellcrush/fidelity.h"
#include "docs/tables/record_tables.h"
#include "validation/options.h"

namespace cellcrush::docs {

SeedStatistics CrushGroup::of(const std::string& column) const {
  std::vector<double> values;
  for (const bench::CsvRow& row : rows) {
    if (const double value = bench::number_in(row, column); std::isfinite(value)) values.push_back(value);
  }
  return statistics_of(values);
}

double CrushGroup::greatest(const std::string& column) const {
  double greatest = std::numeric_limits<double>::quiet_NaN();
  for (const bench::CsvRow& row : rows) greatest = std::fmax(greatest, bench::number_in(row, column));
  return greatest;
}

std::vector<CrushGroup> read_groups(const std::string& list, const std::string& record) {
  const std::vector<bench::CsvRow> all = bench::read_csv(record);
  std::vector<CrushGroup> groups;
  for (const bench::VariedScene& scene : bench::read_variants(list)) {
    for (const bench::Variant& variant : scene.variants) {
      const SceneSpec spec = fill_in_fidelity(validation::read_options(bench::words_of(scene, variant, 1)).spec);
      SceneSpec without_mesh = spec;
      without_mesh.elements_per_wall.reset();
      CrushGroup group = {scene.name,
                          variant.name,
                          scene.words.front(),
                          *spec.loading.speed_m_per_s,
                          *spec.elements_per_wall,
                          *fill_in_fidelity(without_mesh).elements_per_wall,
                          {}};
      std::ranges::copy_if(all, std::back_inserter(group.rows), [&](const bench::CsvRow& row) {
        return bench::is_of(row, scene, variant) && row.at("status") == "finished";
      });
      if (!group.rows.empty()) groups.push_back(std::move(group));
    }
  }
  return groups;
}

std::string mean_text(const SeedStatistics& statistics, int decimals) {
  if (statistics.count == 0) return "";
  const std::string mean = fixed(statistics.mean, decimals);
  return statistics.count < 2 ? mean : mean + " ± " + fixed(statistics.deviation, decimals);
}

std::string origin_of(const std::string& file) {
  std::map<std::vector<std::string>, int> counts;
  for (const bench::CsvRow& row : bench::read_csv(file)) {
    ++counts[{row.at("revision"), row.at("machine"), row.at("date")}];
  }
  PageTable table({"Revision", "Machine, kernel", "Day", "#Crushes"});
  for (const auto& [origin, count] : counts) {
    table.add_row({"`" + origin[0] + "`", origin[1], origin[2], std::to_string(count)});
  }
  return table.text();
}

}  // namespace cellcrush::docs
