#pragma once

#include <chrono>
#include <string>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client {

/// For CreateSweep, which checks up to ten thousand points.
inline constexpr std::chrono::minutes kCheckPatience{10};

/// Parses the value of `--over`: PATH=V1,V2,... (a list), PATH=FIRST:LAST:COUNT (evenly spaced),
/// PATH=FIRST:LAST:COUNT:log (logarithmically spaced) or PATH=seeds:N (1 to N). Throws CommandError.
v1::SweepAxis parse_axis(const std::string& text);

/// The field with its values as they were read: "loading.speed_m_per_s = 25, 50 m/s (2 values)".
std::string axis_text(const v1::SweepAxis& axis);

/// Number of grid points of a sweep's axes; a double, since it may exceed any server's limit.
double count_points(const v1::Sweep& sweep);

}  // namespace cellcrush::client
