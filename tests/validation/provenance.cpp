#include "validation/provenance.h"

#include <filesystem>

#include "bench/machine.h"
#include "cellcrush/simd.h"
#ifndef CELLCRUSH_CORE_ONLY
#include "cellcrush/simulation.h"
#include "revision.h"
#include "store/case_hash.h"
#include "translate/spec_to_case.h"
#endif

namespace cellcrush::validation {
namespace {

#ifdef CELLCRUSH_CORE_ONLY
constexpr const char* kSourceRevision = "unknown";

std::string case_hash_of(const SceneSpec&) { return ""; }
#else
std::string case_hash_of(const SceneSpec& spec) {
  const SceneResult built = build_scene(spec);
  return built.scene ? store::hash_of(translate::to_case(complete_spec(spec, *built.scene))) : "";
}
#endif

}  // namespace

Cells origin_of_a_run() {
  return {{"revision", kSourceRevision},
          {"machine", bench::processor_name() + " " + simd_target()},
          {"date", bench::today()}};
}

Cells provenance_of(const Options& options) {
  Cells cells = {{"command", "validate " + options.preset + (options.changes.empty() ? "" : " ") + options.changes},
                 {"curve", std::filesystem::path(options.curve_file).filename()},
                 {"case_hash", case_hash_of(options.spec)}};
  const Cells origin = origin_of_a_run();
  cells.insert(cells.end(), origin.begin(), origin.end());
  return cells;
}

}  // namespace cellcrush::validation
