// tests/bench/README.md: what an element-step takes, and what the shortcuts of the solver save.
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "docs/tables/crush_rows.h"
#include "docs/tables/record_tables.h"

namespace cellcrush::docs {
namespace {

/// A variant of shortcuts.txt that leaves a shortcut out, or "with:..." has one that is off by default.
struct Shortcut {
  const char* variant;
  const char* name;
  const char* switched_off_by;
  const char* agreement;
};

constexpr std::array kShortcuts = {
    Shortcut{"without:faces", "contact search by face", "`contact.search BUCKETS`", "within the scatter of seeds"},
    Shortcut{"without:fibres-of-perfect-plasticity", "fibres without hardening", "a hardening modulus above 0",
             "same ledger"},
    Shortcut{"without:single-precision", "fibres in single precision", "`numerics.fibre_precision DOUBLE`",
             "within the scatter of seeds"},
    Shortcut{"without:rigid-inclusions", "stiff cells as rigid bodies", "`lattice.inclusions.model MESHED`",
             "work within 2 %"},
    Shortcut{"without:few-samples", "1000 samples, not 10,000", "`output.sample_count`", "same bits"},
    Shortcut{"with:rotary-inertia-3", "threefold rotary inertia (off by default)", "`numerics.rotary_scaling 1`",
             "[accuracy.md](../accuracy.md)"},
};

/// Mean processor time of the crushes of a scene and variant; not a number without any.
double seconds_of(const std::vector<CrushGroup>& groups, const std::string& scene, const std::string& variant) {
  for (const CrushGroup& group : groups) {
    if (group.scene == scene && group.variant == variant) return group.of("processor_seconds").mean;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The rows of the newest commit on each machine, with the fastest kernel.
std::string element_step_table() {
  PageTable table(
      {"Crush, strain in %", "#Elements", "#Type I by default = 1", "#ns", "#Scalar = 1", "Processor", "Commit"});
  for (const char* machine : {"amd-epyc", "intel-r-xeon-r-processor"}) {
    const auto rows = bench::read_csv(kTests + "/bench/results/steps-" + machine + ".csv");
    const std::string commit = rows.back().at("commit");
    double of_type_i = std::numeric_limits<double>::quiet_NaN();
    for (const bench::CsvRow& row : rows) {
      if (row.at("commit") == commit && row.at("benchmark") == "type-i-default/20/avx512") {
        of_type_i = bench::number_in(row, "element_step_ns");
      }
    }
    for (const bench::CsvRow& row : rows) {
      if (row.at("commit") != commit || row.at("simd_target") != "avx512") continue;
      const std::string& benchmark = row.at("benchmark");
      const double nanoseconds = bench::number_in(row, "element_step_ns");
      table.add_row({benchmark.substr(0, benchmark.rfind('/')), row.at("elements"), fixed(nanoseconds / of_type_i, 2),
                     fixed(nanoseconds, 1), fixed(bench::number_in(row, "times_as_fast_as_scalar"), 1),
                     row.at("processor"), commit});
    }
  }
  return table.text();
}

}  // namespace

PageTables bench_tables() {
  const std::vector<CrushGroup> groups =
      read_groups(kTests + "/bench/shortcuts.txt", kTests + "/bench/results/shortcuts.csv");
  PageTable table({"Shortcut", "Switched off by", "Agreement", "#100 m/s", "#10 m/s", "#1 m/s"});
  for (const Shortcut& shortcut : kShortcuts) {
    std::vector<std::string> cells = {shortcut.name, shortcut.switched_off_by, shortcut.agreement};
    for (const char* scene : {"type-i-100", "type-i-10", "example-3"}) {
      const double ratio = seconds_of(groups, scene, shortcut.variant) / seconds_of(groups, scene, "with:all");
      cells.push_back(fixed(std::string(shortcut.variant).starts_with("with:") ? 1.0 / ratio : ratio, 2));
    }
    table.add_row(cells);
  }
  return {{"element-steps", element_step_table()}, {"shortcuts", table.text()}};
}

}  // namespace cellcrush::docs
