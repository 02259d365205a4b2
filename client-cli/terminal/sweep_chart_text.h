#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client {

/// A sweep's plateau stress at the impact plate against the first varied field, as a character plot: one mark per
/// series, and shock theory as dots if the field is the speed. No line is wider than `width`. Empty unless a series has
/// two points.
std::string sweep_chart_text(const v1::SweepTable& table, bool unicode, int width);

}  // namespace cellcrush::client
