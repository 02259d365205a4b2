#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::jobs {

/// A number as people write it, with all its digits: "50", "0.3464", "1e-07".
std::string text_of(double value);

/// Sets the number at a path of a case: "loading.speed_m_per_s", "lattice.hexagon.rows", "lattice.frame.nodes[3].x_mm".
/// Parts that are absent are made, but no kind of lattice is changed into another, and a list does not grow. Throws
/// InvalidField, with the path as the field: no such number, or a value that is not whole or does not fit where the
/// field is a whole number.
void set_case_field(v1::Case& target, const std::string& path, double value);

}  // namespace cellcrush::jobs
