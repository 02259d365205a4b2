#include "case_file/typed_number.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <regex>

namespace cellcrush::client {
namespace {

constexpr std::size_t kLongest = 64;

bool matches(std::string_view text, std::cmatch& parts, const std::regex& form) {
  return text.size() <= kLongest && std::regex_match(text.data(), text.data() + text.size(), parts, form);
}

}  // namespace

TypedNumber read_real(std::string_view text) {
  static const std::regex form(R"([ \t]*([+-]?)(\d*)(?:([.,])(\d*))?(?:[eE]([+-]?\d+))?[ \t]*)");
  std::cmatch parts;
  const bool is_number = matches(text, parts, form) && parts.length(2) + parts.length(4) > 0;
  if (!is_number) return {"", "is not a number: write digits with a point, such as 0.35 or 2e-7"};
  const std::string sign = parts.str(1) == "-" ? "-" : "";
  const std::string whole = parts.length(2) > 0 ? parts.str(2) : "0";
  const std::string fraction = parts.str(4);
  const std::string exponent = parts[5].matched ? "e" + parts.str(5) : "";
  const std::string digits = fraction.substr(0, fraction.find_last_not_of('0') + 1);
  const std::string shortest = sign + whole + (digits.empty() ? "" : "." + digits) + exponent;
  if (parts.str(3) == "," && whole.size() <= 3 && whole[0] != '0' && fraction.size() == 3) {
    const std::string thousands = sign + whole + fraction + exponent;
    return {"", fmt::format("could be {0} or {1}: write {0} or {1}", shortest, thousands)};
  }
  const double value = std::strtod(shortest.c_str(), nullptr);
  const bool is_zero = (whole + fraction).find_first_not_of('0') == std::string::npos;
  if (std::isinf(value) || (value == 0.0 && !is_zero)) return {"", "is beyond the range of numbers, 1e-308 to 1e308"};
  return {sign + whole + (fraction.empty() ? "" : "." + fraction) + exponent, ""};
}

TypedNumber read_whole(std::string_view text) {
  static const std::regex form(R"([ \t]*([+-]?)(\d+)[ \t]*)");
  std::cmatch parts;
  if (!matches(text, parts, form)) return {"", "is not a whole number: write digits only, such as 12"};
  return {(parts.str(1) == "-" ? "-" : "") + parts.str(2), ""};
}

}  // namespace cellcrush::client
