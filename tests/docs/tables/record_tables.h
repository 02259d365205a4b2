#pragma once

#include <string>

#include "docs/tables/page_tables.h"

namespace cellcrush::docs {

inline const std::string kTests = std::string(CELLCRUSH_SOURCE_ROOT) + "/tests";

// The tables of a page from the records of crushes that tests do not run. Throw std::invalid_argument on a record that
// cannot be read. What was not measured has no row.

PageTables accuracy_tables();    ///< tests/accuracy.md, of tests/bench/results/work_precision.csv
PageTables bench_tables();       ///< tests/bench/README.md, of results/shortcuts.csv and steps-MACHINE.csv
PageTables long_crush_tables();  ///< tests/validation/RESULTS.md, of example_2.csv, modes.csv and records/
PageTables mesh_tables();        ///< core/what-is-computed.md, of tests/bench/results/mesh_study.csv
PageTables stability_tables();   ///< tests/stability/README.md, of its maps

/// A table of the machines, revisions and days of a record's rows, and how many rows each has.
std::string origin_of(const std::string& file);

}  // namespace cellcrush::docs
