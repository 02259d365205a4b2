#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace cellcrush {

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

/// case.proto and sample.proto with their comments, which generated descriptors lack. They live as long as the program.
const google::protobuf::DescriptorPool& commented_protos();

/// The comment above a declaration of commented_protos(); empty if there is none.
template <typename Declaration>
std::string comment_above(const Declaration& declaration) {
  google::protobuf::SourceLocation location;
  return declaration.GetSourceLocation(&location) ? join_comment(location.leading_comments) : std::string();
}

/// What a field of sample.proto means, by its comment: "Time since the start of the run."
std::string meaning_of(const google::protobuf::FieldDescriptor& field);

/// The files of commented_protos(), compiled by protoc at build time: a serialized google.protobuf.FileDescriptorSet.
std::string_view proto_descriptors();

}  // namespace cellcrush
