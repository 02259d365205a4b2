#pragma once

#include <string>

#include "cellcrush/scene_spec.h"
#include "validation/crush_table.h"
#include "validation/options.h"

namespace cellcrush::validation {

/// What a row of a record leads with: the command without its files, the curve's file, the case's hash, the sources'
/// revision, the processor with the kernel in use, the day.
Cells provenance_of(const Options& options);

/// SHA-256, in hexadecimal, of the completed case as the services carry it (server/store/case_hash.h); empty in a build
/// of the solver alone, which knows no case, and of a spec with problems.
std::string case_hash_of(const SceneSpec& spec);

/// Revision of the sources when the build was configured; "unknown" in a build of the solver alone.
std::string source_revision();

}  // namespace cellcrush::validation
