#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::jobs {

/// A number in its usual form, with all digits: "50", "0.3464", "1e-07".
std::string text_of(double value);

/// Sets a number of a case by its path: "loading.speed_m_per_s", "lattice.hexagon.rows", "lattice.frame.nodes[3].x_mm".
/// Creates absent parts, but never changes the kind of lattice or extends a list. Throws InvalidField, with the path as
/// the field, if the path names no number. It also throws if the value does not fit an integer field.
void set_case_field(v1::Case& target, const std::string& path, double value);

}  // namespace cellcrush::jobs
