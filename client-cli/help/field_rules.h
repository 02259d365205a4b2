#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace cellcrush::client {

/// Default of a field by its options (cellcrush/v1/field.proto): "required" if there is none; empty if they state
/// neither.
std::string default_of(const google::protobuf::FieldDescriptor& field);

/// Limits of a field by its options, such as "1e-6 to half of side_mm"; empty: only those of the type.
std::string limits_of(const google::protobuf::FieldDescriptor& field);

/// What a field is in: the unit at the end of its name, such as m/s for "_m_per_s" of "speed_m_per_s"; empty if there
/// is none.
struct FieldUnit {
  std::string_view suffix;
  std::string_view unit;
};
FieldUnit find_unit(std::string_view field_name);
std::string unit_of(std::string_view field_name);

/// Comment lines as text: line ends become spaces, empty lines end a paragraph ("\n\n").
std::string join_comment(const std::string& lines);

/// The first sentence of a text, including its full stop.
std::string first_sentence(const std::string& text);

}  // namespace cellcrush::client
