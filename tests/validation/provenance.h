#pragma once

#include "validation/crush_table.h"

namespace cellcrush::validation {

/// Where a row of a record comes from: the sources' revision when the build was configured ("unknown" in a build of the
/// solver alone), the processor with the kernel in use, the day.
Cells origin_of_a_run();

/// What the row of a long crush leads with: the command without its files, the curve's file, the SHA-256 of the
/// completed case as the services carry it (server/store/case_hash.h), and origin_of_a_run(). The hash is empty in a
/// build of the solver alone, which knows no case, and for a spec with problems.
Cells provenance_of(const Options& options);

}  // namespace cellcrush::validation
