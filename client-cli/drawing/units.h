#pragma once

#include <optional>
#include <string>

namespace cellcrush::drawing {

/// Millimetres in a unit of length: mm, cm, m, um, in, ft, pt, px (of 96 in an inch). None for an unknown one.
std::optional<double> mm_in(const std::string& unit);

/// The same; throws CommandError (refused) for an unknown one.
double mm_per(const std::string& unit);

/// Millimetres in a unit of DXF's $INSUNITS; none for 0, no unit, and for those of other quantities.
std::optional<double> mm_in_dxf_unit(int number);

}  // namespace cellcrush::drawing
