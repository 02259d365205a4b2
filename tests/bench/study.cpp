#include "bench/study.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <utility>

#include "bench/precision.h"
#include "cellcrush/fidelity.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

const std::string kFolder = CELLCRUSH_BENCH_FOLDER;
const std::string kPresets = kFolder + "/../../server/presets/";
const std::string kExample2 = kFolder + "/../validation/example_2";

}  // namespace

Study read_study(const std::string& name) {
  return {read_variants(kFolder + "/" + name + ".txt"), read_csv(kFolder + "/results/" + name + ".csv")};
}

Study read_example_2() { return {read_variants(kExample2 + ".txt"), read_csv(kExample2 + ".csv")}; }

std::vector<double> values_of(const Study& study, const VariedScene& scene, const Variant& variant,
                              const std::string& column) {
  std::vector<double> values;
  for (const CsvRow& row : study.rows) {
    if (!is_of(row, scene, variant)) continue;
    EXPECT_EQ(row.at("status"), "finished") << scene.name << " " << variant.name;
    values.push_back(number_in(row, column));
  }
  return values;
}

bool is_of_default_elements(const VariedScene& scene, const Variant& variant) {
  const SceneSpec spec = validation::read_options(words_of(scene, variant, 1)).spec;
  SectionSpec section;
  NumericsSpec numerics = spec.numerics;
  numerics.mass_scaling = numerics.rotary_scaling = 1.0;
  numerics.fibre_precision = NumericsSpec().fibre_precision;
  return spec.section == section && spec.numerics == numerics && spec.numerics.time_step_s == 0.0 &&
         spec.contact == ContactSpec();
}

std::vector<MeshResult> results_of(const Study& study, const VariedScene& scene, const std::string& column) {
  std::map<int, MeshResult> results;
  for (const Variant& variant : scene.variants) {
    if (!is_of_default_elements(scene, variant)) continue;
    const SceneSpec spec = fill_in_fidelity(validation::read_options(words_of(scene, variant, 1)).spec);
    const auto values = values_of(study, scene, variant, column);
    if (values.size() >= kLeastSeeds && results[*spec.elements_per_wall].values.empty()) {
      results[*spec.elements_per_wall] = {*spec.elements_per_wall, values};
    }
  }
  std::vector<MeshResult> list;
  list.reserve(results.size());
  for (auto& [elements, result] : results) list.push_back(std::move(result));
  return list;
}

std::vector<std::string> preset_rows(const std::string& table) {
  std::ifstream file(kPresets + table + ".csv");
  std::vector<std::string> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) rows.push_back(line);
  return rows;
}

void write_preset_rows(const std::string& table, const std::vector<std::string>& rows) {
  std::string names;
  std::ifstream before(kPresets + table + ".csv");
  std::getline(before, names);
  before.close();
  std::ofstream file(kPresets + table + ".csv");
  file << names << "\n";
  for (const std::string& row : rows) file << row << "\n";
}

}  // namespace cellcrush::bench
