#pragma once

#include <google/protobuf/descriptor.h>

#include <string_view>

namespace cellcrush::client {

/// The enum value of this name, ignoring case: "y" is Y. nullptr if there is none.
const google::protobuf::EnumValueDescriptor* find_enum_value(std::string_view name,
                                                             const google::protobuf::EnumDescriptor& type);

/// The enum type of the case fields with this name; nullptr if there is none, or more than one.
const google::protobuf::EnumDescriptor* find_enum_of_field(std::string_view field);

}  // namespace cellcrush::client
