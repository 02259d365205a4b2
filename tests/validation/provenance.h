#pragma once

#include "validation/crush_table.h"

namespace cellcrush::validation {

/// What a row of a record leads with: the command without its files, the curve's file, the SHA-256 of the completed
/// case as the services carry it (server/store/case_hash.h), the sources' revision when the build was configured, the
/// processor with the kernel in use, the day. In a build of the solver alone, which knows no case, and for a spec with
/// problems the hash is empty; there the revision is "unknown".
Cells provenance_of(const Options& options);

}  // namespace cellcrush::validation
