#pragma once

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/problem.pb.h"

namespace cellcrush::translate {

/// The lists of the case that are longer than any case needs; checked before anything else. A message of 4 MiB can hold
/// millions of empty entries, each of which would cause several problems. Limits: 200000 nodes, beams, supports, loads
/// and points of time functions; 10000 motions and watched nodes; 1000 rigid walls; 10000 rows of inclusions.
google::protobuf::RepeatedPtrField<v1::Problem> find_long_lists(const v1::Case& submitted);

/// Maximum number of problems listed for one case; the rest are only counted.
inline constexpr int kMostProblems = 1000;

/// Truncates the problems to kMostProblems plus one that counts the rest.
void cut_problems(google::protobuf::RepeatedPtrField<v1::Problem>& problems);

}  // namespace cellcrush::translate
