#pragma once

#include <google/protobuf/descriptor.h>

#include <string_view>

namespace cellcrush::client {

/// The value of an enumeration of that name, in capitals or not: "y" is Y. nullptr when there is none.
const google::protobuf::EnumValueDescriptor* find_enum_value(std::string_view name,
                                                             const google::protobuf::EnumDescriptor& type);

/// The enumeration that the fields of that name have in a case; nullptr when there is none, or when there are several.
const google::protobuf::EnumDescriptor* find_enum_of_field(std::string_view field);

}  // namespace cellcrush::client
