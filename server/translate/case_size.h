#pragma once

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/problem.pb.h"

namespace cellcrush::translate {

/// The lists of the case that are longer than any case needs, before anything else is done with it: a message of 4 MiB
/// can hold millions of empty entries, each of which would be several problems. Nodes, beams, supports, loads and
/// points of time functions: 200000; motions and watched nodes: 10000; rows of inclusions: 10000.
google::protobuf::RepeatedPtrField<v1::Problem> find_long_lists(const v1::Case& submitted);

/// Problems that are told of one case; of the rest only the number is.
inline constexpr int kMostProblems = 1000;

/// Cuts the problems to kMostProblems and one that counts the rest.
void cut_problems(google::protobuf::RepeatedPtrField<v1::Problem>& problems);

}  // namespace cellcrush::translate
