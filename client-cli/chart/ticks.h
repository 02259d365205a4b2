#pragma once

#include <string>
#include <vector>

namespace cellcrush::client {

/// Round values on an axis: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 0.0;
  std::vector<double> values;  ///< ascending, within the range
};

/// At most `most` ticks from `low` to `high`. REQUIRES: low < high, both finite, most >= 2.
Ticks find_ticks(double low, double high, int most);

/// A tick's value with as many decimals as its step requires.
std::string tick_label(double value, double step);

/// Ticks of a logarithmic axis: powers of ten, with 2 and 5 times these if at most `most` in total; over many decades
/// only every second power, third and so on. `step` is 0. REQUIRES: 0 < low < high, both finite, most >= 2.
Ticks find_logarithmic_ticks(double low, double high, int most);

/// A value of a logarithmic axis, with all its digits.
std::string logarithmic_tick_label(double value);

}  // namespace cellcrush::client
