#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// What a field's comment says, by the convention of case.proto: one sentence is "Default X; LIMITS." or "Required,
/// LIMITS.", each with or without limits, and what the field is stands before it.
struct FieldComment {
  std::string summary;        ///< the first sentence about the field itself
  std::string default_value;  ///< "required" for one without; empty when the comment says neither
  std::string limits;
};

/// Lines of a comment as text: line ends become spaces, empty lines end a paragraph ("\n\n").
std::string join_comment(const std::string& lines);

FieldComment parse_field_comment(std::string_view comment);

/// The sentences of a text, with their full stops.
std::vector<std::string> split_sentences(std::string_view text);

/// The unit that ends a field's name, such as m/s for "speed_m_per_s"; empty when it ends with none.
std::string unit_of(std::string_view field_name);

}  // namespace cellcrush::client
