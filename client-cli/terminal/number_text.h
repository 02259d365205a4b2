#pragma once

#include <cstdint>
#include <string>

namespace cellcrush::client {

/// `digits` significant digits, without an exponent from 0.001 to 999999: "3.41", "0.0866", "2.00e-07".
std::string number_text(double value, int digits = 3);

/// Grouped in thousands from five digits on: "9642", "20 500".
std::string count_text(std::int64_t value);

/// "0.8 s", "48 s", "12 min 03 s", "3 h 05 min".
std::string duration_text(double seconds);

/// "512 B", "12.3 MB"; a kB is 1000 B.
std::string size_text(std::int64_t bytes);

/// A share as a percentage: "47.3 %".
std::string percent_text(double share, int decimals = 1);

}  // namespace cellcrush::client
