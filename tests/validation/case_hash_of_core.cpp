// The solver alone knows neither cases nor the revision of the sources.
#include "validation/provenance.h"

namespace cellcrush::validation {

std::string case_hash_of(const SceneSpec&) { return ""; }

std::string source_revision() { return "unknown"; }

}  // namespace cellcrush::validation
