// Runs a preset and says what its crush amounts to; beside it a row of a table, the curve as CSV and the lattice's
// frames.
//   validate papka-kyriakides-1 elements=4 table=runs.csv curve=curve.csv frames=frames

#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "cellcrush/simd.h"
#include "validation/crush_run.h"
#include "validation/crush_table.h"
#include "validation/options.h"
#include "validation/provenance.h"
#include "validation/records.h"

namespace cellcrush::validation {
namespace {

/// Curve and frames are written as they come.
CrushRun run(const Options& options) {
  if (!use_simd_target(options.simd_target)) {
    std::string targets;
    for (const std::string& target : simd_targets()) {
      targets += (targets.empty() ? "" : " or ") + target;
    }
    throw std::invalid_argument("simd=" + options.simd_target + ": this processor cannot run it; give " + targets +
                                ".");
  }
  std::optional<CurveFile> curve;
  std::optional<FramesFile> frames;
  CrushWatch watch;
  if (!options.curve_file.empty()) {
    curve.emplace(options.curve_file);
    watch.on_sample = [&](const Sample& sample) { curve->add(sample); };
  }
  if (!options.frames_file.empty()) {
    watch.on_start = [&](const Scene& scene) { frames.emplace(options.frames_file, mesh_of(scene)); };
    watch.on_frame = [&](const FieldFrame& frame) { frames->add(frame); };
  }
  return run_crush(options.spec, options.until, watch);
}

}  // namespace
}  // namespace cellcrush::validation

int main(int count, char** words) {
  using namespace cellcrush::validation;
  try {
    const Options options = read_options({words + 1, words + count});
    const CrushRun crush = run(options);
    std::cout << describe(options, crush) << std::flush;
    if (!options.table_file.empty()) {
      append_row(options.table_file, options, crush, provenance_of(options));
    }
    using Kind = cellcrush::RunStatus::Kind;
    return crush.status.kind == Kind::finished || crush.status.kind == Kind::running ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\nvalidate PRESET [name=value ...]\n" << describe_options();
    return 2;
  }
}
