#pragma once

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/sample.pb.h"

namespace cellcrush {

/// Ids of the two rigid side walls (loading.sides), after those of the rigid walls of a case.
inline constexpr const char* kSideWallIds[] = {"side_low", "side_high"};

/// A sample with the parts of a case, by their ids and in the order of the case, and without any number: watched nodes,
/// rigid walls, side walls and grips.
v1::Sample sample_parts_of(const v1::Case& submitted);

}  // namespace cellcrush
