// tests/accuracy.md: what work_precision has measured.
#include <algorithm>
#include <cmath>

#include "bench/precision.h"
#include "docs/tables/record_tables.h"

namespace cellcrush::docs {
namespace {

using bench::Precision;

struct Words {
  std::string variant;
  std::string words;
};

const std::vector<Words> kElements = {{"elements:1", "1 (DRAFT)"},
                                      {"default:2", "2, the default (STANDARD)"},
                                      {"elements:4", "4"},
                                      {"converged:8", "8 (REFERENCE)"},
                                      {"paper:1", "1 of the paper's"},
                                      {"paper:2", "2 of the paper's"},
                                      {"paper:4", "4 of the paper's"},
                                      {"paper:8", "8 of the paper's"},
                                      {"displacement:1", "1 displacement-based"},
                                      {"displacement:2", "2 displacement-based"},
                                      {"displacement:4", "4 displacement-based"}};

const std::vector<Words> kSettings = {{"default:2", "none"},
                                      {"precision:double", "fibres in double precision"},
                                      {"search:buckets", "contact search by buckets"},
                                      {"rotary:3", "threefold rotary inertia"},
                                      {"penalty:x4", "fourfold contact stiffness"},
                                      {"damping:0", "no damping of contacts"},
                                      {"damping:.5", "2.5 times the damping of contacts"},
                                      {"damping:1", "critical damping of contacts"},
                                      {"step:.5", "half of the step"},
                                      {"step:.25", "a quarter of the step"}};

std::string error_text(const Precision& found, bool is_reference) {
  if (is_reference) return "known to ±" + percent(found.uncertainty, 1);
  if (found.error < found.uncertainty) return "under " + percent(found.uncertainty, 1);
  return percent_of(found.error, found.uncertainty, 1);
}

/// The precisions of all measures of a scene, by variant.
std::map<std::string, std::map<std::string, Precision>> all_precisions(const bench::VariedScene& scene,
                                                                       const std::vector<bench::CsvRow>& rows) {
  std::map<std::string, std::map<std::string, Precision>> all;
  for (const bench::Measure& measure : bench::kMeasures) {
    double scatter = 0.0;
    for (const Precision& found : bench::precisions(scene, rows, measure, bench::kConverged, scatter)) {
      all[found.variant][measure.column] = found;
    }
  }
  return all;
}

std::string precision_table(const std::string& scene_name, const std::string& head, const std::vector<Words>& choices) {
  const std::string folder = kTests + "/bench/";
  const std::vector<bench::CsvRow> rows = bench::read_csv(folder + "results/work_precision.csv");
  PageTable table({head, "#Seeds", "#Time, s", "#Support plateau", "#Impact plateau", "#Limit stress", "#Ledger"});
  for (const bench::VariedScene& scene : bench::read_variants(folder + "work_precision.txt")) {
    if (scene.name != scene_name) continue;
    const auto all = all_precisions(scene, rows);
    for (const auto& [variant, words] : choices) {
      const auto found = all.find(variant);
      if (found == all.end()) continue;
      std::vector<std::string> cells = {words};
      for (const bench::Measure& measure : bench::kMeasures) {
        const Precision& precision = found->second.at(measure.column);
        if (cells.size() == 1) {
          cells.push_back(std::to_string(precision.seeds));
          cells.push_back(fixed(precision.seconds, precision.seconds < 9.95 ? 1 : 0));
        }
        cells.push_back(measure.absolute ? percent(precision.error, 2)
                                         : error_text(precision, variant == bench::kConverged));
      }
      table.add_row(cells);
    }
  }
  return table.text();
}

}  // namespace

PageTables accuracy_tables() {
  return {{"elements of type-i", precision_table("type-i", "Elements per wall", kElements)},
          {"settings of type-i", precision_table("type-i", "Setting that is changed", kSettings)},
          {"elements of example-1", precision_table("example-1", "Elements per wall", kElements)},
          {"origin of accuracy", origin_of(kTests + "/bench/results/work_precision.csv")}};
}

}  // namespace cellcrush::docs
