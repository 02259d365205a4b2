#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush {

/// Number of values that an axis asks for, unchecked: below 0 if its count is.
int count_values(const v1::SweepAxis& axis);

/// The fields that a sweep varies: those of its axes in their order, else those of its first point, sorted.
std::vector<std::string> swept_fields(const v1::Sweep& sweep);

}  // namespace cellcrush
