#pragma once

namespace cellcrush {

// Written at every build, by stamp_revision.cmake.

extern const char* const kVersion;
/// Commit of the sources, with "-dirty" if the work tree had changes; "unknown" outside a repository.
extern const char* const kSourceRevision;
/// Writer of a result: version and revision.
extern const char* const kSolverRevision;
/// Everything besides case and processor that determines the bits of a run: version, and a hash of the solver's
/// sources, the compiler and its flags. A run never continues a checkpoint of a different revision.
extern const char* const kSolverIdentity;
/// What to cite for a result: the message of CITATION.cff.
extern const char* const kCitation;

}  // namespace cellcrush
