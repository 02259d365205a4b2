#include <algorithm>
#include <vector>

#include "docs/page.h"
#include "docs/proto_comments.h"
#include "docs/proto_pages.h"
#include "help/field_comment.h"

namespace cellcrush::docs {

namespace pb = google::protobuf;

namespace {

constexpr const char* kFieldsHead = R"(<!-- Made from proto/cellcrush/v1/case.proto. To rewrite this page:
     CELLCRUSH_WRITE_PAGES=1 build/ci/bin/proto_pages_test -->
# Fields of a case

This page lists every field of a case, for authors of case files and of clients. The types and comments of
[case.proto](cellcrush/v1/case.proto) are its source; `cellcrush explain PATH` prints the same entry of one field.

Each section is a group of fields. Its heading is the path of the group, as messages, `--set` and sweeps write it.
Ranges include their ends, unless the limit says "below". A missing required field or a value out of limits is a problem
with the path of the field; see [errors.md](errors.md). "The paper" and its equations (Eq.) are named in
[what-is-computed.md](../core/what-is-computed.md). The messages around a case are in [api.md](api.md); the overview of
this folder is [README.md](README.md).
)";

// A group of fields, and the shortest path to it.
struct Group {
  std::string path;
  const pb::Descriptor* type;
};

std::string join(const std::string& path, const std::string& name) { return path.empty() ? name : path + "." + name; }

bool is_among(const std::vector<Group>& groups, const pb::Descriptor* type) {
  return std::any_of(groups.begin(), groups.end(), [type](const Group& group) { return group.type == type; });
}

// Breadth first, so that each type is met on its shortest path.
std::vector<Group> find_groups(const pb::Descriptor* type) {
  std::vector<Group> groups{{"", type}};
  for (std::size_t next = 0; next < groups.size(); ++next) {
    const Group parent = groups[next];
    for (int i = 0; i < parent.type->field_count(); ++i) {
      const pb::FieldDescriptor& field = *parent.type->field(i);
      if (field.message_type() == nullptr || is_among(groups, field.message_type())) continue;
      groups.push_back({join(parent.path, field.name()), field.message_type()});
    }
  }
  return groups;
}

// All of a comment but the sentence that names default and limits, which have columns of their own.
std::string description_of(const std::string& comment) {
  std::string out;
  for (const std::string& sentence : client::split_sentences(comment)) {
    if (sentence.starts_with("Default") || sentence.starts_with("Required")) continue;
    out += (out.empty() ? "" : " ") + sentence;
  }
  return out;
}

std::string type_of(const pb::FieldDescriptor& field, const std::vector<Group>& groups) {
  std::string text = "`" + type_text(field) + "`";
  if (field.message_type() == nullptr) return text;
  const auto group = std::find_if(groups.begin(), groups.end(),
                                  [&field](const Group& known) { return known.type == field.message_type(); });
  return link(text, "#" + anchor_of(group->path));
}

std::string row_of(const pb::FieldDescriptor& field, const std::vector<Group>& groups) {
  const std::string comment = comment_above(field);
  const client::FieldComment parsed = client::parse_field_comment(comment);
  const bool is_group = field.message_type() != nullptr;
  const std::string unit = client::unit_of(field.name());
  std::string limits = parsed.limits;
  if (field.real_containing_oneof() != nullptr) limits = "one of `" + field.real_containing_oneof()->name() + "`";
  const std::string default_value = parsed.default_value.empty() && !is_group ? "none" : parsed.default_value;
  return "| `" + field.name() + "` | " + type_of(field, groups) + " | " + unit + " | " + cell(default_value) + " | " +
         cell(limits) + " | " + cell(description_of(comment)) + " |\n";
}

std::string values_of(const pb::FieldDescriptor& field) {
  const pb::EnumDescriptor& type = *field.enum_type();
  std::string out = "\n" + paragraph("Values of `" + field.name() + "`. " + comment_above(type)) + "\n";
  out += "| Value | Meaning |\n|---|---|\n";
  for (int i = 0; i < type.value_count(); ++i) {
    const pb::EnumValueDescriptor& value = *type.value(i);
    if (value.number() != 0) out += "| `" + value.name() + "` | " + cell(comment_above(value)) + " |\n";
  }
  return out;
}

std::string section_of(const Group& group, const std::vector<Group>& groups) {
  std::string out = "\n## " + (group.path.empty() ? "case" : group.path) + "\n\n";
  out += paragraph(comment_above(*group.type)) + "\n";
  out += "| Field | Type | Unit | Default | Limits | Meaning |\n|---|---|---|---|---|---|\n";
  for (int i = 0; i < group.type->field_count(); ++i) out += row_of(*group.type->field(i), groups);
  for (int i = 0; i < group.type->field_count(); ++i) {
    if (group.type->field(i)->enum_type() != nullptr) out += values_of(*group.type->field(i));
  }
  return out;
}

}  // namespace

std::string make_fields_page() {
  const std::vector<Group> groups = find_groups(find_proto("case").FindMessageTypeByName("Case"));
  std::string out = kFieldsHead;
  for (const Group& group : groups) out += section_of(group, groups);
  return out;
}

}  // namespace cellcrush::docs
