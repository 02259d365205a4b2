#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// The parts of a field's comment, by the convention of case.proto: one sentence is "Default X; LIMITS." or "Required,
/// LIMITS.", each with or without limits; the description precedes it.
struct FieldComment {
  std::string summary;        ///< the first sentence about the field itself
  std::string default_value;  ///< "required" if there is none; empty if the comment states neither
  std::string limits;
};

/// Comment lines as text: line ends become spaces, empty lines end a paragraph ("\n\n").
std::string join_comment(const std::string& lines);

FieldComment parse_field_comment(std::string_view comment);

/// The sentences of a text, including their full stops.
std::vector<std::string> split_sentences(std::string_view text);

/// The unit at the end of a field's name, such as m/s for "speed_m_per_s"; empty if there is none.
std::string unit_of(std::string_view field_name);

}  // namespace cellcrush::client
