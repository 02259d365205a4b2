#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// Names of the fields of a message, in order of declaration.
std::vector<std::string> field_names(const google::protobuf::Descriptor& type);

/// Paths of all fields of a case, including messages, each before its own fields.
std::vector<std::string> case_paths();

/// The message for a field that `type` does not have: a sentence with the shortest path to a field of that name, else
/// with the nearest name of `type`, else with the path to the nearest name of all; or with all names of `type` if none
/// is near.
std::string unknown_field_message(std::string_view field, const google::protobuf::Descriptor& type);

/// The message for a value that `type` does not have: a sentence with all its names.
std::string unknown_enum_message(std::string_view value, const google::protobuf::EnumDescriptor& type);

/// The enum value of this name, ignoring case: "y" is Y. nullptr if there is none.
const google::protobuf::EnumValueDescriptor* find_enum_value(std::string_view name,
                                                             const google::protobuf::EnumDescriptor& type);

/// The enum type of the case fields with this name; nullptr if there is none, or more than one.
const google::protobuf::EnumDescriptor* find_enum_of_field(std::string_view field);

/// A part of a path such as "nodes[3]" of "lattice.frame.nodes[3].x_mm".
struct PathPart {
  std::string text;   ///< as it stands
  std::string name;   ///< before a bracket
  std::string index;  ///< between brackets; empty where they do not close

  [[nodiscard]] bool has_index() const { return name != text; }
};
std::vector<PathPart> split_path(std::string_view path);

}  // namespace cellcrush::client
