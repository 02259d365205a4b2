// core/what-is-computed.md: how far the mean plateaus of a mesh lie from those of a finer one.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "docs/tables/crush_rows.h"
#include "docs/tables/record_tables.h"

namespace cellcrush::docs {
namespace {

const std::string kBench = kTests + "/bench/";
const std::string kImpact = "plateau_stress_impact";
const std::string kSupport = "plateau_stress_support";

/// The meshes of a scene by their elements per wall.
using Meshes = std::map<int, CrushGroup>;

/// By speed, of the scenes whose names begin so.
std::map<double, Meshes> meshes_of(const std::vector<CrushGroup>& groups, const std::string& name) {
  std::map<double, Meshes> all;
  for (const CrushGroup& group : groups) {
    const std::string rest = group.scene.substr(std::min(group.scene.size(), name.size()));
    if (!group.scene.starts_with(name) || rest.find_first_not_of("0123456789") != std::string::npos) continue;
    all[group.speed][group.elements_per_wall] = group;
  }
  return all;
}

/// "-2.1 ± 0.9 % ", in bold where it exceeds its interval and `bound`. Empty where one of the meshes is missing.
std::string difference(const Meshes& meshes, int elements, int finer, const std::string& column) {
  if (!meshes.contains(elements) || !meshes.contains(finer)) return "";
  const SeedStatistics one = meshes.at(elements).of(column);
  const SeedStatistics other = meshes.at(finer).of(column);
  if (one.count < 2 || other.count < 2) return "";
  const double share = one.mean / other.mean - 1.0;
  const double uncertainty = interval_of_difference(one, other) / other.mean;
  const double bound = column == kImpact ? 0.04 : 0.10;
  const std::string text =
      signed_percent(share, 1).substr(0, signed_percent(share, 1).size() - 2) + " ± " + percent(uncertainty, 1);
  return std::abs(share) > std::max(bound, uncertainty) ? "**" + text + "**" : text;
}

struct Comparison {
  int elements;
  int finer;
};

/// Rows of a specimen, one a speed: the differences at the impact plate, then at the support plate.
void add_rows(PageTable& table, const std::vector<CrushGroup>& groups, const std::string& scenes,
              const std::string& words, const std::vector<Comparison>& comparisons) {
  for (const auto& [speed, meshes] : meshes_of(groups, scenes)) {
    std::vector<std::string> cells = {words, fixed(speed, 0)};
    for (const std::string& column : {kImpact, kSupport}) {
      for (const auto& [elements, finer] : comparisons) cells.push_back(difference(meshes, elements, finer, column));
    }
    table.add_row(cells);
  }
}

/// "kagome along y" of "kagome-along-y-25"; "hexagons, walls 10 times as long as thick" of "hexagons-10-25".
std::string cells_of(const std::string& scene) {
  std::string words = scene.substr(0, scene.rfind('-'));
  const std::size_t last = words.rfind('-') + 1;
  if (last > 0 && std::isdigit(static_cast<unsigned char>(words[last])) != 0) {
    return words.substr(0, last - 1) + ", walls " + words.substr(last) + " times as long as thick";
  }
  std::ranges::replace(words, '-', ' ');
  std::ranges::replace(words, '_', '-');
  return words;
}

/// The default mesh of each scene of a list against one twice as fine.
PageTable default_meshes(const std::string& list) {
  PageTable table({"Cells", "#Plate speed, m/s", "#Default", "#Impact: against twice", "#Support: against twice"});
  std::vector<std::pair<std::string, Meshes>> scenes;
  for (const CrushGroup& group : read_groups(kBench + list + ".txt", kBench + "results/" + list + ".csv")) {
    if (scenes.empty() || scenes.back().first != group.scene) scenes.push_back({group.scene, {}});
    scenes.back().second[group.elements_per_wall] = group;
  }
  for (const auto& [scene, meshes] : scenes) {
    const auto& [speed, elements] = std::pair(meshes.begin()->second.speed, meshes.begin()->second.default_elements);
    table.add_row({cells_of(scene), fixed(speed, 0), std::to_string(elements),
                   difference(meshes, elements, 2 * elements, kImpact),
                   difference(meshes, elements, 2 * elements, kSupport)});
  }
  return table;
}

std::vector<std::string> heads_of(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> heads = {"Cells", "#Plate speed, m/s"};
  for (const std::string plate : {"Impact", "Support"}) {
    for (const auto& [elements, finer] : comparisons) {
      heads.push_back("#" + plate + ": " + std::to_string(elements) + " against " + std::to_string(finer));
    }
  }
  return heads;
}

}  // namespace

PageTables mesh_tables() {
  const auto groups = read_groups(kBench + "mesh_study.txt", kBench + "results/mesh_study.csv");
  const auto presets = read_groups(kTests + "/validation/example_2.txt", kTests + "/validation/example_2.csv");
  const auto hardening = read_groups(kBench + "hardening_study.txt", kBench + "results/hardening_study.csv");
  const std::vector<Comparison> along_x = {{1, 8}, {2, 8}, {4, 8}};
  const std::vector<Comparison> doubled = {{8, 16}, {16, 32}};
  const std::vector<Comparison> along_y = {{2, 16}, {4, 16}, {8, 16}};
  const std::vector<Comparison> halved = {{8, 16}};
  PageTable hexagons(heads_of(along_x));
  add_rows(hexagons, groups, "type-i-", "`type-i`", along_x);
  PageTable small(heads_of(doubled));
  add_rows(small, groups, "squares-", "18 x 9 squares", doubled);
  add_rows(small, hardening, "squares-75-hardening", "the same, hardening", doubled);
  add_rows(small, groups, "triangles-", "18 x 9 triangles", doubled);
  PageTable y(heads_of(along_y));
  add_rows(y, groups, "hexagons-along-y-", "18 x 21 hexagons", along_y);
  PageTable whole(heads_of(halved));
  add_rows(whole, presets, "type-ii-as-counted-", "`type-ii-as-counted`", halved);
  add_rows(whole, presets, "type-iii-as-counted-", "`type-iii-as-counted`", halved);
  return {{"meshes of hexagons", hexagons.text()},
          {"meshes of squares and triangles", small.text()},
          {"meshes of hexagons along y", y.text()},
          {"meshes of presets", whole.text()},
          {"meshes of other kinds", default_meshes("kind_study").text()},
          {"meshes of slender and stout walls", default_meshes("slenderness_study").text()},
          {"origin of other meshes", origin_of(kBench + "results/kind_study.csv")},
          {"origin of slender and stout walls", origin_of(kBench + "results/slenderness_study.csv")},
          {"origin of meshes", origin_of(kBench + "results/mesh_study.csv")}};
}

}  // namespace cellcrush::docs
