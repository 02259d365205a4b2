#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

namespace cellcrush::client {

/// What a person typed for a number. The web page reads by the same rules (server/page/src/new_case/typed_number.ts),
/// and tests/scenes/typed_numbers.csv holds both to them.
struct TypedNumber {
  std::string plain;    ///< as programs write it, such as "1.5" of "1,5"; empty if it is none
  std::string problem;  ///< why it is none, with the remedy, to follow the text: "is not a number: ..."
};

/// Reads a real number. A comma is a decimal sign, unless it may separate thousands: "1,200" is a problem.
TypedNumber read_real(std::string_view text);

/// Reads a whole number of any size: digits only.
TypedNumber read_whole(std::string_view text);

/// Whether the plain form fits the type, and its value.
template <typename Number>
bool parse_plain(std::string_view plain, Number& value) {
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  return error == std::errc() && end == plain.data() + plain.size();
}

}  // namespace cellcrush::client
