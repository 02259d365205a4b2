// Runs a preset and says what its crush amounts to; beside it a row of a table and the curve as CSV.
//   validate papka-kyriakides-1 elements=4 table=runs.csv curve=curve.csv

#include <exception>
#include <iostream>

#include "validation/crush_run.h"
#include "validation/crush_table.h"
#include "validation/options.h"

int main(int count, char** words) {
  using namespace cellcrush::validation;
  try {
    const Options options = read_options({words + 1, words + count});
    const CrushRun run = run_crush(options.spec);
    std::cout << describe(options, run) << std::flush;
    if (!options.table_file.empty()) {
      append_row(options.table_file, options, run);
    }
    if (!options.curve_file.empty()) {
      write_curve(options.curve_file, run);
    }
    return run.status.kind == cellcrush::RunStatus::Kind::finished ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\nvalidate PRESET [name=value ...]\n" << describe_options();
    return 2;
  }
}
