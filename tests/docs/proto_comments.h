#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

#include "columns/field_text.h"

namespace cellcrush::docs {

/// The project's .proto files with their comments. They live as long as the program.
const google::protobuf::DescriptorPool& commented_protos();

/// A file of the project, such as "case" for cellcrush/v1/case.proto. Throws std::runtime_error when there is none.
const google::protobuf::FileDescriptor& find_proto(const std::string& name);

/// The comment above a declaration; empty when there is none.
template <typename Declaration>
std::string comment_above(const Declaration& declaration) {
  google::protobuf::SourceLocation location;
  return declaration.GetSourceLocation(&location) ? join_comment(location.leading_comments) : std::string();
}

/// Name of a message or enum without the package: "Lattice.Hexagon".
std::string short_name(const std::string& full_name);

/// A field's type in Markdown code: "repeated Job", "map<string, string>".
std::string type_text(const google::protobuf::FieldDescriptor& field);

/// Message or enum that the field holds; empty for scalars and maps of them.
std::string type_name(const google::protobuf::FieldDescriptor& field);

/// A text for a cell of a table: paragraphs become one line, and bars are escaped.
std::string cell(const std::string& text);

/// The text in lines of at most 118 columns.
std::string paragraph(const std::string& text);

/// "[text](target)".
std::string link(const std::string& text, const std::string& target);

/// proto/fields.md: every message and field of a case, from case.proto.
std::string make_fields_page();

/// core/fields/field_limits.inc: path, limits and unit of every number of a case that has limits, by path.
std::string make_field_limits();

/// proto/api.md: every service, rpc and message but those of a case, from the comments of the other files.
std::string make_api_page();

}  // namespace cellcrush::docs
