#include "terminal/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cellcrush::client {

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "not a number" : value > 0 ? "infinite" : "-infinite";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e-3 || size >= 1e6) return fmt::format("{:.{}e}", value, digits - 1);
  // The exponent after rounding, so that 0.9996 becomes 1.00 and not 1.000.
  const std::string rounded = fmt::format("{:.{}e}", size, digits - 1);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent));
}

std::string short_text(double value) {
  constexpr double kMostWhole = 1e15;
  if (value == std::floor(value) && std::abs(value) < kMostWhole) return fmt::format("{:.0f}", value);
  return fmt::format("{:.6g}", value);
}

ShownUnit unit_by_size(std::string_view unit, double largest) {
  const double size = std::abs(largest);
  if (unit == "MPa") return size > 0.0 && size < 0.1 ? ShownUnit{"kPa", 1e3} : ShownUnit{"MPa", 1.0};
  if (unit == "mJ") return size >= 1e6 ? ShownUnit{"kJ", 1e-6} : size >= 1e3 ? ShownUnit{"J", 1e-3} : ShownUnit{"mJ"};
  if (unit == "N") return size >= 1e3 ? ShownUnit{"kN", 1e-3} : ShownUnit{"N"};
  if (unit == "s") return ShownUnit{"s"};
  return unit == "%" ? ShownUnit{"%", 100.0} : ShownUnit{};
}

std::string quantity_text(double value, std::string_view unit, int digits) {
  const ShownUnit shown = unit_by_size(unit, value);
  return number_text(shown.factor * value, digits) + " " + shown.name;
}

std::string count_text(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::size_t sign = value < 0 ? 1 : 0;
  if (digits.size() - sign < 5) return digits;
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > sign && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "unknown";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<std::int64_t>(std::llround(std::min(seconds, 1e15)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string size_text(std::int64_t bytes) {
  constexpr std::array kUnits = {"kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} B", bytes);
  double size = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  while (size >= 999.5 && unit + 1 < kUnits.size()) {
    size /= 1000.0;
    ++unit;
  }
  return number_text(size) + " " + kUnits[unit];
}

std::string percent_text(double share, int decimals) {
  const std::string text = fmt::format("{:.{}f} %", 100.0 * share, decimals);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  return is_zero && text.starts_with('-') ? text.substr(1) : text;
}

}  // namespace cellcrush::client
