#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/candidate_lists.h"

namespace cellcrush {

/// The candidates whose capsules overlap now, by ball, segments ascending, whatever order they are listed in. The one test
/// that is made of every candidate in every step: it reads ball, segment and reach, and where they are.
std::vector<Candidate> find_overlaps(const Scene& scene, const State& state);

}  // namespace cellcrush
