#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/study.h"
#include "cellcrush/convergence.h"
#include "scenes/lattices.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

SceneSpec spec_of(const VariedScene& scene) {
  return validation::read_options(words_of(scene, scene.variants.front(), 1)).spec;
}

/// Whether two scenes are the same crush of the same cells, with fewer of them in the first.
bool is_part_of(const VariedScene& part, const VariedScene& whole) {
  SceneSpec few = spec_of(part);
  SceneSpec many = spec_of(whole);
  RegularLattice& few_cells = scenes::cells_of(few);
  RegularLattice& many_cells = scenes::cells_of(many);
  if (part.words.front() != whole.words.front() || *few_cells.rows >= *many_cells.rows) return false;
  few_cells.columns = many_cells.columns;
  few_cells.rows = many_cells.rows;
  few.elements_per_wall = many.elements_per_wall;
  return few == many;
}

/// The rows of a quantity: the meshes that both scenes have.
void add_differences(const VariedScene& part, const std::vector<MeshResult>& of_part,
                     const std::vector<MeshResult>& of_whole, std::string_view quantity,
                     std::vector<std::string>& rows) {
  const SceneSpec spec = spec_of(part);
  const RegularLattice& cells = scenes::cells_of(spec);
  for (const MeshResult& mesh : of_part) {
    for (const MeshResult& same : of_whole) {
      if (same.elements_per_wall != mesh.elements_per_wall) continue;
      const SeedStatistics few = statistics_of(mesh.values);
      const SeedStatistics many = statistics_of(same.values);
      const auto share = [&many](double value) { return std::round(1e4 * value / many.mean) / 1e4; };
      std::ostringstream row;
      row << part.words.front() << "," << quantity << "," << *spec.loading.speed_m_per_s << ","
          << mesh.elements_per_wall << "," << *cells.columns << "," << *cells.rows << "," << share(few.mean - many.mean)
          << "," << share(interval_of_difference(few, many));
      rows.push_back(row.str());
    }
  }
}

std::vector<std::string> differences_of_tables() {
  const Study small = read_study("mesh_study");
  const Study whole = read_example_2();
  std::vector<std::string> rows;
  for (const auto& [quantity, column] :
       {std::pair{"impact plateau", "plateau_stress_impact"}, std::pair{"support plateau", "plateau_stress_support"}}) {
    for (const VariedScene& part : small.scenes) {
      for (const VariedScene& other : whole.scenes) {
        if (!is_part_of(part, other)) continue;
        add_differences(part, results_of(small, part, column), results_of(whole, other, column), quantity, rows);
      }
    }
  }
  return rows;
}

constexpr const char* kTable = "small_specimens";

// CELLCRUSH_WRITE_PAGES=1 writes them.
TEST(SmallSpecimens, AreThoseOfTheTables) {
  const std::vector<std::string> expected = differences_of_tables();
  ASSERT_FALSE(expected.empty());
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) write_preset_rows(kTable, expected);
  EXPECT_EQ(preset_rows(kTable), expected);
}

// `check` names one specimen of a preset.
TEST(SmallSpecimens, APresetHasOne) {
  std::set<std::string> presets;
  std::set<std::string> specimens;
  for (const std::string& row : preset_rows(kTable)) {
    std::istringstream cells(row);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    ASSERT_EQ(values.size(), 8u) << row;
    presets.insert(values[0]);
    specimens.insert(values[0] + " " + values[4] + " x " + values[5]);
  }
  EXPECT_EQ(specimens.size(), presets.size());
}

}  // namespace
}  // namespace cellcrush::bench
