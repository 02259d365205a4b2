#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client {

/// What `--over` says of a field: PATH=V1,V2,... (a list), PATH=FIRST:LAST:COUNT (evenly spaced),
/// PATH=FIRST:LAST:COUNT:log (in the logarithm) or PATH=seeds:N (1 to N). Throws CommandError.
v1::SweepAxis parse_axis(const std::string& text);

/// Points of the grid that the axes of a sweep span; a double, since axes may ask for more than any server takes.
double count_points(const v1::Sweep& sweep);

}  // namespace cellcrush::client
