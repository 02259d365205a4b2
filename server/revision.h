#pragma once

namespace cellcrush {

// Written at every build, by stamp_revision.cmake.

extern const char* const kVersion;
/// Commit of the sources, with "-dirty" if the work tree had changes; "unknown" outside a repository.
extern const char* const kSourceRevision;
/// Writer of a result: version and revision.
extern const char* const kSolverRevision;
/// Semantic versions of what others build on: messages and methods, result.h5, the numbers of a run.
extern const char* const kApiVersion;
extern const char* const kResultVersion;
extern const char* const kSolverVersion;
/// What --version prints after the name of the program.
extern const char* const kVersionText;
/// Everything besides case and processor that determines the bits of a run: the solver's version, and a hash of its
/// sources, the compiler and its flags. A run never continues a checkpoint of a different revision.
extern const char* const kSolverIdentity;
/// What to cite for a result: the message of CITATION.cff.
extern const char* const kCitation;

}  // namespace cellcrush
