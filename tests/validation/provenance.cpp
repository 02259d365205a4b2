#include "validation/provenance.h"

#include <filesystem>

#include "bench/machine.h"
#include "cellcrush/simd.h"

namespace cellcrush::validation {

Cells provenance_of(const Options& options) {
  return {{"command", "validate " + options.preset + (options.changes.empty() ? "" : " ") + options.changes},
          {"curve", std::filesystem::path(options.curve_file).filename()},
          {"case_hash", case_hash_of(options.spec)},
          {"revision", source_revision()},
          {"machine", bench::processor_name() + " " + simd_target()},
          {"date", bench::today()}};
}

}  // namespace cellcrush::validation
