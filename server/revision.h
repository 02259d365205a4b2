#pragma once

namespace cellcrush {

// Written at every build, by stamp_revision.cmake.

extern const char* const kVersion;
/// Commit that the sources were built from, with "-dirty" when the work tree was another; "unknown" outside of a
/// repository.
extern const char* const kSourceRevision;
/// What wrote a result: version and revision.
extern const char* const kSolverRevision;
/// What decides the bits of a run beside case and processor: version, and a hash of the solver's sources, the compiler
/// and its flags. Checkpoints of another one are not continued.
extern const char* const kSolverIdentity;

}  // namespace cellcrush
