#include <google/protobuf/descriptor.pb.h>

#include <array>
#include <vector>

#include "docs/page.h"
#include "docs/proto_comments.h"

namespace cellcrush::docs {

namespace pb = google::protobuf;

namespace {

constexpr const char* kApiHead = R"(<!-- Made from the files of proto/cellcrush/v1. To rewrite this page:
     CELLCRUSH_WRITE_PAGES=1 build/ci/bin/proto_pages_test -->
# API reference

This page lists every rpc and message of the package `cellcrush.v1`, for authors of clients. The comments of the files
in [cellcrush/v1](cellcrush/v1) are its source. The fields of a case are in [fields.md](fields.md), the status codes of
all calls in [errors.md](errors.md), and working clients in [other-languages.md](other-languages.md). The overview of
this folder is [README.md](README.md). Field names end in their units. Equations (Eq.) are those of the paper named in
[what-is-computed.md](../core/what-is-computed.md).
)";

const std::string kOutputOnly = "Output only. ";

bool is_inline(const pb::Descriptor& type) {
  return type.name().ends_with("Request") || type.name().ends_with("Response");
}

bool is_of_case(const std::string& name) {
  for (const char* part :
       {"Case", "Lattice", "Frame", "Material", "Section", "Contact", "Plates", "Loading", "Numerics", "Output"}) {
    if (name == part || name.starts_with(part + std::string("."))) return true;
  }
  return false;
}

constexpr std::array kServiceFiles = {"cases_service", "jobs_service", "sweeps_service", "admin_service"};

// Where a type is described: a request under its rpc.
std::string place_of(const std::string& name) {
  for (const char* file_name : kServiceFiles) {
    const pb::FileDescriptor& file = find_proto(file_name);
    for (int i = 0; i < file.service_count(); ++i) {
      const pb::ServiceDescriptor& service = *file.service(i);
      for (int k = 0; k < service.method_count(); ++k) {
        const pb::MethodDescriptor& rpc = *service.method(k);
        if (is_inline(*rpc.input_type()) && rpc.input_type()->name() == name)
          return anchor_of(service.name() + "." + rpc.name());
      }
    }
  }
  return anchor_of(name);
}

// A type's name, linked to where it is described.
std::string linked(const std::string& text, const std::string& name) {
  std::string code = "`" + text + "`";
  if (name.empty() || name.starts_with("google.")) return code;
  return link(code, is_of_case(name) ? "fields.md" : "#" + place_of(name));
}

bool all_output_only(const pb::Descriptor& type) {
  for (int i = 0; i < type.field_count(); ++i) {
    if (!comment_above(*type.field(i)).starts_with(kOutputOnly)) return false;
  }
  return true;
}

std::string fields_of(const pb::Descriptor& type) {
  if (type.field_count() == 0) return "No fields.\n";
  // Of a message that only the daemon writes it goes without saying.
  const bool drop_prefix = all_output_only(type);
  std::string out = "| Field | Type | Meaning |\n|---|---|---|\n";
  for (int i = 0; i < type.field_count(); ++i) {
    const pb::FieldDescriptor& field = *type.field(i);
    std::string comment = comment_above(field);
    if (drop_prefix) comment.erase(0, kOutputOnly.size());
    if (const auto* choice = field.real_containing_oneof()) comment += " One of `" + choice->name() + "`.";
    out += "| `" + field.name() + "` | " + linked(type_text(field), type_name(field)) + " | " + cell(comment) + " |\n";
  }
  for (int i = 0; i < type.real_oneof_decl_count(); ++i) {
    const std::string comment = comment_above(*type.oneof_decl(i));
    if (!comment.empty()) out += "\n" + paragraph("`" + type.oneof_decl(i)->name() + "`: " + comment);
  }
  return out;
}

std::string message_part(const char* role, const pb::Descriptor& type, bool is_stream) {
  const std::string stream = is_stream ? "stream of " : "";
  const std::string name = short_name(type.full_name());
  if (!is_inline(type)) return std::string("\n") + role + ": " + stream + linked(name, name) + ".\n";
  return std::string("\n") + role + ": " + stream + "`" + name + "`.\n\n" + fields_of(type);
}

std::string rpc_section(const pb::MethodDescriptor& rpc) {
  return "\n### " + rpc.service()->name() + "." + rpc.name() + "\n\n" + paragraph(comment_above(rpc)) +
         message_part("Request", *rpc.input_type(), rpc.client_streaming()) +
         message_part("Response", *rpc.output_type(), rpc.server_streaming());
}

std::string service_section(const pb::ServiceDescriptor& service) {
  std::string out = "\n## " + service.name() + "\n\n" + paragraph(comment_above(service));
  for (int i = 0; i < service.method_count(); ++i) out += rpc_section(*service.method(i));
  return out;
}

std::string enum_section(const pb::EnumDescriptor& type) {
  std::string out = "\n### " + short_name(type.full_name()) + "\n\n" + paragraph(comment_above(type)) +
                    "\n| Value | Number | Meaning |\n|---|---|---|\n";
  for (int i = 0; i < type.value_count(); ++i) {
    const pb::EnumValueDescriptor& value = *type.value(i);
    const std::string comment = value.name().ends_with("UNSPECIFIED") ? "Not set." : comment_above(value);
    out += "| `" + value.name() + "` | " + std::to_string(value.number()) + " | " + cell(comment) + " |\n";
  }
  return out;
}

std::string message_section(const pb::Descriptor& type) {
  std::string out;
  if (!is_inline(type)) {
    out = "\n### " + short_name(type.full_name()) + "\n\n" + paragraph(comment_above(type)) + "\n" + fields_of(type);
  }
  for (int i = 0; i < type.nested_type_count(); ++i) {
    if (!type.nested_type(i)->options().map_entry()) out += message_section(*type.nested_type(i));
  }
  for (int i = 0; i < type.enum_type_count(); ++i) out += enum_section(*type.enum_type(i));
  return out;
}

}  // namespace

std::string make_api_page() {
  std::string out = kApiHead;
  std::string messages = "\n## Messages\n";
  for (const char* name : {"cases_service", "jobs_service", "sweeps_service", "admin_service", "job", "event", "sample",
                           "sweep", "problem"}) {
    const pb::FileDescriptor& file = find_proto(name);
    for (int i = 0; i < file.service_count(); ++i) out += service_section(*file.service(i));
    for (int i = 0; i < file.message_type_count(); ++i) messages += message_section(*file.message_type(i));
    for (int i = 0; i < file.enum_type_count(); ++i) messages += enum_section(*file.enum_type(i));
  }
  return out + messages;
}

}  // namespace cellcrush::docs
