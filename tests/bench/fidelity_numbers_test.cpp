#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/precision.h"
#include "bench/study.h"
#include "cellcrush/convergence.h"
#include "cellcrush/fidelity.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

constexpr auto kAlongY = LoadingSpec::Direction::y;

/// The rows of a quantity in one scene: its meshes of the default element, at least kLeastSeeds seeds each.
void add_rows(const Study& study, const VariedScene& scene, std::string_view quantity, const std::string& column,
              std::vector<std::string>& rows) {
  const SceneSpec spec = validation::read_options(words_of(scene, scene.variants.front(), 1)).spec;
  const RegularLattice& lattice = scenes::cells_of(spec);
  const std::string& preset = scene.words.front();
  const bool is_smaller = lattice != scenes::cells_of(scenes::preset(preset));
  const auto found = estimate_convergence(results_of(study, scene, column));
  if (!found) return;
  for (const MeshMean& mesh : found->meshes) {
    const auto rounded = [](double share) { return std::round(1e4 * share) / 1e4; };
    std::ostringstream row;
    row << preset << "," << quantity << "," << *spec.loading.speed_m_per_s << "," << mesh.elements_per_wall << ","
        << rounded(mesh.error) << "," << rounded(found->uncertainty()) << ","
        << rounded(mesh.of_seeds.deviation / mesh.of_seeds.mean) << "," << (is_smaller ? *lattice.columns : 0) << ","
        << (is_smaller ? *lattice.rows : 0) << "," << (spec.loading.direction == kAlongY ? "y" : "x");
    rows.push_back(row.str());
  }
}

std::vector<std::string> rows_of_tables() {
  std::vector<std::string> rows;
  const Study meshes = read_study("mesh_study");
  for (const VariedScene& scene : meshes.scenes) {
    add_rows(meshes, scene, "impact plateau", "plateau_stress_impact", rows);
    add_rows(meshes, scene, "support plateau", "plateau_stress_support", rows);
  }
  const Study precision = read_study("work_precision");
  for (const VariedScene& scene : precision.scenes) {
    if (scene.name == "example-1") add_rows(precision, scene, "limit stress", "limit_stress", rows);
  }
  return rows;
}

constexpr const char* kMeasuredErrors = "measured_errors";

// CELLCRUSH_WRITE_PAGES=1 writes them.
TEST(FidelityNumbers, AreThoseOfTheTables) {
  const std::vector<std::string> expected = rows_of_tables();
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) write_preset_rows(kMeasuredErrors, expected);
  EXPECT_EQ(preset_rows(kMeasuredErrors), expected);
}

const std::map<std::string, double> kBounds = {{"plateau_stress_impact", 0.04}, {"plateau_stress_support", 0.10}};

/// How far the mean of a mesh lies from that of one twice as fine, relative to the latter.
struct MeshDifference {
  double size = 0.0;
  double uncertainty = 0.0;  ///< half of the 95 % confidence interval
};

/// None if one of the meshes has too few seeds.
std::optional<MeshDifference> difference_from_twice_as_fine(const Study& study, const VariedScene& scene, int elements,
                                                            const std::string& column) {
  std::map<int, SeedStatistics> of_mesh;
  for (const Variant& variant : scene.variants) {
    const std::vector<double> values = values_of(study, scene, variant, column);
    if (values.size() < kLeastSeeds) continue;
    of_mesh[*validation::read_options(words_of(scene, variant, 1)).spec.elements_per_wall] = statistics_of(values);
  }
  if (!of_mesh.contains(elements) || !of_mesh.contains(2 * elements)) return std::nullopt;
  const SeedStatistics& fine = of_mesh[2 * elements];
  return MeshDifference{std::abs(of_mesh[elements].mean - fine.mean) / fine.mean,
                        interval_of_difference(of_mesh[elements], fine) / fine.mean};
}

/// Scenes of a study whose names begin with `name`.
std::vector<VariedScene> scenes_of(const Study& study, std::string_view name) {
  std::vector<VariedScene> scenes;
  std::ranges::copy_if(study.scenes, std::back_inserter(scenes),
                       [name](const VariedScene& scene) { return scene.name.starts_with(name); });
  EXPECT_FALSE(scenes.empty()) << name;
  return scenes;
}

/// Names and columns of the scenes in which a mesh is beyond the bounds, and beyond what scatter alone makes.
std::vector<std::string> beyond_bounds(const Study& study, std::string_view name, int elements) {
  std::vector<std::string> beyond;
  for (const VariedScene& scene : scenes_of(study, name)) {
    for (const auto& [column, bound] : kBounds) {
      const auto difference = difference_from_twice_as_fine(study, scene, elements, column);
      if (difference && difference->size >= std::max(bound, difference->uncertainty)) {
        beyond.push_back(scene.name + " " + column);
      }
    }
  }
  return beyond;
}

// All meshes of a spec are then compared on the same one.
TEST(FidelityNumbers, APresetHasOneSpecimenForEachDirection) {
  std::map<std::string, std::set<std::string>> specimens;
  for (const std::string& row : preset_rows(kMeasuredErrors)) {
    const std::string cells = row.substr(row.rfind(',', row.rfind(',', row.rfind(',') - 1) - 1));
    specimens[row.substr(0, row.find(',')) + row.substr(row.rfind(','))].insert(cells);
  }
  for (const auto& [name, cells] : specimens) EXPECT_EQ(cells.size(), 1u) << name;
}

int standard_of(const char* preset, LoadingSpec::Direction direction, double speed) {
  SceneSpec spec = scenes::preset(preset);
  spec.loading.direction = direction;
  spec.loading.speed_m_per_s = speed;
  return *fill_in_fidelity(spec).elements_per_wall;
}

/// Scenes whose names begin so, a mesh, and where it is beyond the bounds.
struct Beyond {
  std::string scenes;
  int elements;
  std::vector<std::string> names;
};

// STANDARD of hexagons along x is the coarsest mesh that runs at all speeds, and is within the bounds. 18 x 9 triangles
// are beyond them at the impact plate of 50 m/s, 18 x 9 squares at the support of 100 m/s, because their walls do not
// harden (core/what-is-computed.md); coarser meshes are so at more speeds. Of 18 x 21 hexagons along y STANDARD keeps
// the bounds at 25 m/s. Above, half as many elements have another support plateau. Of the whole presets scatter hides
// all differences but that of the support of squares at 75 m/s, which is too low.
TEST(FidelityNumbers, MeshesBeyondTheBoundsAreKnown) {
  const Study study = read_study("mesh_study");
  const int of_hexagons = standard_of("type-i", LoadingSpec::Direction::x, 100.0);
  const int of_triangles = standard_of("type-iii-as-counted", LoadingSpec::Direction::x, 100.0);
  const int of_squares = standard_of("type-ii-as-counted", LoadingSpec::Direction::x, 100.0);
  const int along_y = standard_of("type-i", kAlongY, 100.0);
  for (const auto& [scenes, elements, names] : std::vector<Beyond>{
           {"type-i-", of_hexagons, {}},
           {"triangles-", of_triangles, {"triangles-50 plateau_stress_impact"}},
           {"triangles-",
            of_triangles / 2,
            {"triangles-25 plateau_stress_support", "triangles-50 plateau_stress_impact",
             "triangles-50 plateau_stress_support", "triangles-100 plateau_stress_support"}},
           {"squares-",
            of_squares / 2,
            {"squares-25 plateau_stress_impact", "squares-25 plateau_stress_support",
             "squares-75 plateau_stress_impact", "squares-100 plateau_stress_impact"}},
           {"squares-", of_squares, {"squares-100 plateau_stress_support"}},
           {"hexagons-along-y-25", standard_of("type-i", kAlongY, 25.0), {}},
           {"hexagons-along-y-",
            along_y / 2,
            {"hexagons-along-y-50 plateau_stress_impact", "hexagons-along-y-150 plateau_stress_support",
             "hexagons-along-y-200 plateau_stress_support"}},
           {"hexagons-along-y-",
            along_y,
            {"hexagons-along-y-50 plateau_stress_impact", "hexagons-along-y-200 plateau_stress_support"}}}) {
    EXPECT_EQ(beyond_bounds(study, scenes, elements), names) << scenes << " " << elements;
  }
  for (const VariedScene& scene : scenes_of(study, "type-i-")) {
    for (const auto& [column, bound] : kBounds) {
      const auto difference = difference_from_twice_as_fine(study, scene, of_hexagons, column);
      ASSERT_TRUE(difference.has_value()) << scene.name;
      EXPECT_LT(difference->size, bound) << scene.name << " " << column;
    }
  }
  EXPECT_EQ(beyond_bounds(read_example_2(), "type-ii", 8), std::vector<std::string>());
}

// Without hardening they differ by 13 % at impact.
TEST(FidelityNumbers, SquaresThatHardenAreAlikeWithEightAndSixteenElements) {
  const Study study = read_study("hardening_study");
  ASSERT_EQ(study.scenes.size(), 1u);
  for (const auto& [column, bound] : kBounds) {
    const auto difference = difference_from_twice_as_fine(study, study.scenes.front(), 8, column);
    ASSERT_TRUE(difference.has_value());
    EXPECT_LT(difference->size, difference->uncertainty) << column;
    EXPECT_LT(difference->size, bound) << column;
  }
}

}  // namespace
}  // namespace cellcrush::bench
