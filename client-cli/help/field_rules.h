#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace cellcrush::client {

/// Default of a field by its options (cellcrush/v1/field.proto): "required" if there is none; empty if they state
/// neither.
std::string default_of(const google::protobuf::FieldDescriptor& field);

/// Limits of a field by its options, such as "1e-6 to half of side_mm"; empty: only those of the type.
std::string limits_of(const google::protobuf::FieldDescriptor& field);

/// The first sentence of a text, including its full stop.
std::string first_sentence(const std::string& text);

}  // namespace cellcrush::client
