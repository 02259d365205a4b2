#pragma once

#include <string>
#include <vector>

#include "bench/csv_table.h"
#include "bench/variants.h"
#include "cellcrush/convergence.h"

namespace cellcrush::bench {

/// Fewest seeds from which a mean is taken.
inline constexpr std::size_t kLeastSeeds = 3;

/// The scenes of a list with the rows of its table.
struct Study {
  std::vector<VariedScene> scenes;
  std::vector<CsvRow> rows;
};

/// A list of this folder and its table in results/.
Study read_study(const std::string& name);

/// Example 2 (tests/validation): hexagons with 2 elements per wall, squares and triangles with 8 and with 16.
Study read_example_2();

/// A column of a variant's crushes, one value for each seed.
std::vector<double> values_of(const Study& study, const VariedScene& scene, const Variant& variant,
                              const std::string& column);

/// Whether a variant is the default element, whatever the mesh.
bool is_of_default_elements(const VariedScene& scene, const Variant& variant);

/// A column with each mesh of the default element that has at least kLeastSeeds seeds.
std::vector<MeshResult> results_of(const Study& study, const VariedScene& scene, const std::string& column);

/// The rows of a table of server/presets, which is made from the studies, without its line of names.
std::vector<std::string> preset_rows(const std::string& table);
void write_preset_rows(const std::string& table, const std::vector<std::string>& rows);

}  // namespace cellcrush::bench
