// How far the default mesh of every kind of lattice is from one twice as fine, as `check` says it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/study.h"
#include "cellcrush/convergence.h"
#include "cellcrush/fidelity.h"
#include "cellcrush/lattice_words.h"
#include "cellcrush/simulation.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

constexpr const char* kDefaultMeshes = "default_meshes";

double rounded(double value) { return std::round(1e4 * value) / 1e4; }

std::string name_of_lattice(const SceneSpec& spec) {
  const auto* cells = std::get_if<RegularLattice>(&spec.lattice);
  if (cells == nullptr) return "voronoi";
  const auto angle = cells->own.find("angle_degrees");
  return (angle != cells->own.end() && angle->second < 0.0 ? "re-entrant " : "") + cells->kind;
}

double density_of(const SceneSpec& spec) {
  const SceneResult result = build_scene(spec);
  EXPECT_TRUE(result.scene);
  return std::round(1e3 * facts_of(*result.scene).relative_density) / 1e3;
}

const MeshResult* find_mesh(const std::vector<MeshResult>& meshes, int elements) {
  const auto found = std::ranges::find(meshes, elements, &MeshResult::elements_per_wall);
  return found == meshes.end() ? nullptr : &*found;
}

/// Empty if one of the two meshes was not crushed.
std::optional<std::string> row_of(const Study& study, const VariedScene& scene, std::string_view quantity,
                                  const std::string& column) {
  SceneSpec spec = validation::read_options(words_of(scene, scene.variants.front(), 1)).spec;
  spec.elements_per_wall.reset();
  spec = fill_in_fidelity(spec);
  const int elements = *spec.elements_per_wall;
  const std::vector<MeshResult> meshes = results_of(study, scene, column);
  const MeshResult* coarse = find_mesh(meshes, elements);
  const MeshResult* fine = find_mesh(meshes, 2 * elements);
  if (coarse == nullptr || fine == nullptr) return std::nullopt;
  const SeedStatistics one = statistics_of(coarse->values);
  const SeedStatistics other = statistics_of(fine->values);
  std::ostringstream row;
  row << name_of_lattice(spec) << "," << (spec.loading.direction == LoadingSpec::Direction::y ? "y" : "x") << ","
      << quantity << "," << *spec.loading.speed_m_per_s << "," << density_of(spec) << "," << elements << ","
      << rounded(one.mean / other.mean - 1.0) << "," << rounded(interval_of_difference(one, other) / other.mean);
  return row.str();
}

std::vector<std::string> rows_of_studies() {
  std::vector<std::string> rows;
  for (const char* name : {"mesh_study", "kind_study", "slenderness_study"}) {
    const Study study = read_study(name);
    for (const VariedScene& scene : study.scenes) {
      for (const auto& [quantity, column] : {std::pair{"impact plateau", "plateau_stress_impact"},
                                             std::pair{"support plateau", "plateau_stress_support"}}) {
        if (const auto row = row_of(study, scene, quantity, column)) rows.push_back(*row);
      }
    }
  }
  return rows;
}

// CELLCRUSH_WRITE_PAGES=1 writes them.
TEST(DefaultMeshes, AreThoseOfTheTables) {
  const std::vector<std::string> expected = rows_of_studies();
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) write_preset_rows(kDefaultMeshes, expected);
  EXPECT_EQ(preset_rows(kDefaultMeshes), expected);
}

TEST(DefaultMeshes, WereMeasuredOfEveryKindAtThreeSpeeds) {
  std::vector<std::string> names = lattice_names();
  names.emplace_back("voronoi");
  names.emplace_back("re-entrant hexagon");
  for (const std::string& name : names) {
    std::set<std::string> speeds;
    for (const std::string& row : preset_rows(kDefaultMeshes)) {
      std::istringstream cells(row);
      std::vector<std::string> values;
      for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
      if (values.front() == name) speeds.insert(values[3]);
    }
    EXPECT_GE(speeds.size(), 3u) << name;
  }
}

}  // namespace
}  // namespace cellcrush::bench
