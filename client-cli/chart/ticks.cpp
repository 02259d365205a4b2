#include "chart/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cellcrush::client {

Ticks find_ticks(double low, double high, int most) {
  constexpr double kSlack = 1e-9;
  double power = std::pow(10.0, std::floor(std::log10((high - low) / most)));
  while (true) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = factor * power;
      const double first = std::ceil(low / step - kSlack);
      const double last = std::floor(high / step + kSlack);
      if (last - first + 1 > most) continue;
      Ticks ticks{step, {}};
      for (double i = first; i <= last; i += 1.0) ticks.values.push_back(i * step);
      return ticks;
    }
    power *= 10.0;
  }
}

std::string tick_label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

Ticks find_logarithmic_ticks(double low, double high, int most) {
  constexpr double kSlack = 1e-9;
  const int first = static_cast<int>(std::floor(std::log10(low) + kSlack));
  const int last = static_cast<int>(std::floor(std::log10(high) + kSlack));
  const auto collect = [&](const std::vector<double>& factors, int stride) {
    Ticks ticks;
    for (int power = first; power <= last; ++power) {
      for (const double factor : factors) {
        const double value = factor * std::pow(10.0, power);
        if (power % stride == 0 && value >= low * (1.0 - kSlack) && value <= high * (1.0 + kSlack)) {
          ticks.values.push_back(value);
        }
      }
    }
    return ticks;
  };
  Ticks ticks = collect({1.0, 2.0, 5.0}, 1);
  for (int stride = 1; static_cast<int>(ticks.values.size()) > most; ++stride) ticks = collect({1.0}, stride);
  return ticks;
}

std::string logarithmic_tick_label(double value) { return fmt::format("{:.6g}", value); }

}  // namespace cellcrush::client
