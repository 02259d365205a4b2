#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/precision.h"
#include "cellcrush/convergence.h"
#include "cellcrush/fidelity.h"
#include "cellcrush/presets.h"
#include "scene/measured_rows.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

const std::string kFolder = CELLCRUSH_BENCH_FOLDER;
const std::string kExample2 = kFolder + "/../validation/example_2_";
constexpr std::size_t kLeastSeeds = 3;

/// The scenes of a list with the rows of its table.
struct Study {
  std::vector<VariedScene> scenes;
  std::vector<CsvRow> rows;
};

Study read_study(const std::string& name) {
  return {read_variants(kFolder + "/" + name + ".txt"), read_csv(kFolder + "/results/" + name + ".csv")};
}

/// Example 2 with the default mesh and with one twice as fine, of which only squares and triangles were crushed.
Study read_example_2() {
  Study study = {read_variants(kExample2 + "seeds.txt"), read_csv(kExample2 + "seeds.csv")};
  const Study fine = {read_variants(kExample2 + "mesh.txt"), read_csv(kExample2 + "mesh.csv")};
  for (VariedScene& scene : study.scenes) {
    for (const VariedScene& other : fine.scenes) {
      if (other.name != scene.name) continue;
      EXPECT_EQ(other.words, scene.words);
      scene.variants.insert(scene.variants.end(), other.variants.begin(), other.variants.end());
    }
  }
  study.rows.insert(study.rows.end(), fine.rows.begin(), fine.rows.end());
  return study;
}

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

/// Whether a variant is the default element, whatever the mesh.
bool is_of_default_elements(const VariedScene& scene, const Variant& variant) {
  const SceneSpec spec = validation::read_options(words_of(scene, variant, 1)).spec;
  SectionSpec section;
  NumericsSpec numerics = spec.numerics;
  numerics.mass_scaling = numerics.rotary_scaling = 1.0;
  numerics.fibre_precision = NumericsSpec().fibre_precision;
  return spec.section == section && spec.numerics == numerics && spec.numerics.time_step_s == 0.0 &&
         spec.contact == ContactSpec();
}

/// The rows of a quantity in one scene: its meshes of the default element, at least kLeastSeeds seeds each.
void add_rows(const Study& study, const VariedScene& scene, std::string_view quantity, const std::string& column,
              std::vector<MeasuredRow>& rows) {
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
  for (auto& [elements, result] : results) list.push_back(std::move(result));
  const SceneSpec spec = validation::read_options(words_of(scene, scene.variants.front(), 1)).spec;
  for (const MeshEstimate& estimate : estimate_mesh_errors(std::move(list))) {
    const auto rounded = [](double share) { return std::round(1e4 * share) / 1e4; };
    rows.push_back({find_preset(scene.words.front())->name, quantity, *spec.loading.speed_m_per_s,
                    estimate.elements_per_wall, rounded(estimate.error), rounded(estimate.uncertainty),
                    rounded(estimate.of_seeds.deviation / estimate.of_seeds.mean)});
  }
}

std::vector<MeasuredRow> rows_of_tables() {
  std::vector<MeasuredRow> rows;
  const Study meshes = read_study("mesh_study");
  for (const VariedScene& scene : meshes.scenes) {
    add_rows(meshes, scene, "impact plateau", "plateau_stress_impact", rows);
    add_rows(meshes, scene, "support plateau", "plateau_stress_support", rows);
  }
  const Study example_2 = read_example_2();
  for (const VariedScene& scene : example_2.scenes) {
    add_rows(example_2, scene, "impact plateau", "plateau_stress_impact", rows);
    add_rows(example_2, scene, "support plateau", "plateau_stress_support", rows);
  }
  const Study precision = read_study("work_precision");
  for (const VariedScene& scene : precision.scenes) {
    if (scene.name == "example-1") add_rows(precision, scene, "limit stress", "limit_stress", rows);
  }
  return rows;
}

std::string text_of(const MeasuredRow& row) {
  std::ostringstream text;
  text << "    {\"" << row.preset << "\", \"" << row.quantity << "\", " << row.speed_m_per_s << ", "
       << row.elements_per_wall << ", " << row.error << ", " << row.uncertainty << ", " << row.scatter << "},";
  return text.str();
}

double time_of_element_step(const VariedScene& scene, const Variant& variant, const std::vector<CsvRow>& rows) {
  double seconds = 0.0;
  double element_steps = 0.0;
  for (const CsvRow& row : rows) {
    if (!is_of(row, scene, variant)) continue;
    seconds += number_in(row, "processor_seconds");
    element_steps += number_in(row, "elements") * number_in(row, "steps");
  }
  return seconds / element_steps;
}

// CELLCRUSH_WRITE_ROWS=1 prints the rows instead, for core/scene/measured_rows.h.
TEST(FidelityNumbers, AreThoseOfTheTables) {
  const std::vector<MeasuredRow> expected = rows_of_tables();
  if (std::getenv("CELLCRUSH_WRITE_ROWS") != nullptr) {
    for (const MeasuredRow& row : expected) std::cout << text_of(row) << "\n";
    GTEST_SKIP() << "printed";
  }
  ASSERT_EQ(kMeasuredRows.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(text_of(kMeasuredRows[i]), text_of(expected[i]));
}

// The means of STANDARD lie within the bounds of a mesh twice as fine wherever that was measured; those of half as many
// elements do not.
TEST(FidelityNumbers, StandardIsTheCoarsestMeshWithinTheBounds) {
  const Study study = read_study("mesh_study");
  const std::map<std::string, double> bounds = {{"plateau_stress_impact", 0.04}, {"plateau_stress_support", 0.10}};
  std::map<std::string, bool> coarser_fails;
  for (const VariedScene& scene : study.scenes) {
    const SceneSpec spec = validation::read_options(scene.words).spec;
    const int standard = fidelity_points(spec)[1].elements_per_wall;
    for (const auto& [column, bound] : bounds) {
      std::map<int, SeedStatistics> of_mesh;
      for (const Variant& variant : scene.variants) {
        const int elements = *validation::read_options(words_of(scene, variant, 1)).spec.elements_per_wall;
        const std::vector<double> values = values_of(study, scene, variant, column);
        if (values.size() >= kLeastSeeds) of_mesh[elements] = statistics_of(values);
      }
      for (const int elements : {standard / 2, standard}) {
        if (!of_mesh.contains(elements) || !of_mesh.contains(2 * elements)) continue;
        const SeedStatistics& coarse = of_mesh[elements];
        const SeedStatistics& fine = of_mesh[2 * elements];
        const double difference = std::abs(coarse.mean - fine.mean) / fine.mean;
        if (elements == standard) {
          EXPECT_LT(difference, bound) << scene.name << " " << column;
        } else {
          coarser_fails[scene.words.front()] |= difference > bound;
        }
      }
    }
  }
  for (const auto& [preset, fails] : coarser_fails) EXPECT_TRUE(fails) << preset;
}

// Squares and triangles scatter so much that means of five seeds hardly tell a mesh from one twice as fine within the
// same bounds: all differences but one are below the bounds or below what scatter alone makes. The exception is the
// support of squares at 75 m/s: it is too low.
TEST(FidelityNumbers, StandardOfSquaresAndTrianglesIsToldFromAMeshTwiceAsFineInOneCase) {
  int compared = 0;
  for (const MeasuredRow& row : kMeasuredRows) {
    const SceneSpec& spec = find_preset(row.preset)->spec;
    const int standard = fidelity_points(spec)[1].elements_per_wall;
    if (standard != 8 || row.elements_per_wall != standard) continue;
    const double bound = row.quantity == "impact plateau" ? 0.04 : 0.10;
    const bool is_told =
        row.preset == "type-ii-as-counted" && row.quantity == "support plateau" && row.speed_m_per_s == 75.0;
    EXPECT_EQ(row.error >= std::max(bound, row.uncertainty), is_told) << text_of(row);
    ++compared;
  }
  EXPECT_GE(compared, 12);
}

TEST(FidelityNumbers, TimesOfElementStepsAreThoseOfTheTables) {
  const Study study = read_study("work_precision");
  const VariedScene& scene = study.scenes.front();
  std::map<int, double> times;
  for (const Variant& variant : scene.variants) {
    if (!is_of_default_elements(scene, variant)) continue;
    const SceneSpec spec = fill_in_fidelity(validation::read_options(words_of(scene, variant, 1)).spec);
    times.try_emplace(*spec.elements_per_wall, time_of_element_step(scene, variant, study.rows));
  }
  ASSERT_EQ(times.size(), 4u);
  for (const auto& [elements, time] : times) EXPECT_NEAR(step_cost_of(elements), time / times[2], 0.03) << elements;
}

}  // namespace
}  // namespace cellcrush::bench
