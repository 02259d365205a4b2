#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cellcrush::client {

/// `digits` significant digits, without an exponent from 0.001 to 999999: "3.41", "0.0866", "2.00e-07".
std::string number_text(double value, int digits = 3);

/// A value as it was given, in at most six significant digits: "50", "0.3", "3.4641". Whole numbers in full.
std::string short_text(double value);

/// A unit, and the factor to it from the unit of the field.
struct ShownUnit {
  const char* name = "";
  double factor = 1.0;
};

/// The unit in which to show numbers in "MPa", "mJ", "N", "s", "%" (of a fraction) or "" when the largest has this
/// size. Stresses below 0.1 MPa are shown in kPa, energies from 1000 mJ in J and from 1000 J in kJ, forces from 1000 N
/// in kN. Every output follows this rule; the numbers of a column, an axis or a group take the unit of their largest.
ShownUnit unit_by_size(std::string_view unit, double largest);

/// A single number in the unit of its size: "3.41 MPa", "86.6 kPa", "5.12 J".
std::string quantity_text(double value, std::string_view unit, int digits = 3);

/// Grouped in thousands from five digits on: "9642", "20 500".
std::string count_text(std::int64_t value);

/// "0.8 s", "48 s", "12 min 03 s", "3 h 05 min".
std::string duration_text(double seconds);

/// "512 B", "12.3 MB"; a kB is 1000 B.
std::string size_text(std::int64_t bytes);

/// A share as a percentage: "47.3 %".
std::string percent_text(double share, int decimals = 1);

}  // namespace cellcrush::client
