#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "cellcrush/v1/field.pb.h"
#include "docs/page.h"
#include "docs/proto_comments.h"
#include "help/field_rules.h"

namespace cellcrush::docs {

namespace pb = google::protobuf;

namespace {

constexpr const char* kFieldsHead = R"(<!-- Made from proto/cellcrush/v1/case.proto. To rewrite this page:
     CELLCRUSH_WRITE_PAGES=1 build/ci/bin/proto_pages_test -->
# Fields of a case

This page lists every field of a case, for authors of case files and of clients. The types, comments and
options of [case.proto](cellcrush/v1/case.proto) are its source; `cellcrush explain PATH` prints the same entry of one
field.

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

std::string type_of(const pb::FieldDescriptor& field, const std::vector<Group>& groups) {
  std::string text = "`" + type_text(field) + "`";
  if (field.message_type() == nullptr) return text;
  const auto group = std::find_if(groups.begin(), groups.end(),
                                  [&field](const Group& known) { return known.type == field.message_type(); });
  return link(text, "#" + anchor_of(group->path));
}

std::string row_of(const pb::FieldDescriptor& field, const std::vector<Group>& groups) {
  const std::string own = client::default_of(field);
  const std::string limits = field.real_containing_oneof() != nullptr
                                 ? "one of `" + field.real_containing_oneof()->name() + "`"
                                 : client::limits_of(field);
  return "| `" + field.name() + "` | " + type_of(field, groups) + " | " + unit_of(field.name()) + " | " +
         cell(own.empty() && field.message_type() == nullptr ? "none" : own) + " | " + cell(limits) + " | " +
         cell(comment_above(field)) + " |\n";
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

// A line for each number with limits, keyed by its path.
void list_limits(const pb::Descriptor& type, const std::string& path, std::map<std::string, std::string>& lines) {
  for (int i = 0; i < type.field_count(); ++i) {
    const pb::FieldDescriptor& field = *type.field(i);
    const std::string at = join(path, field.name());
    if (field.message_type() != nullptr) list_limits(*field.message_type(), at, lines);
    const v1::FieldRules& rules = field.options().GetExtension(v1::rules);
    const bool is_number = field.cpp_type() == pb::FieldDescriptor::CPPTYPE_DOUBLE ||
                           field.cpp_type() == pb::FieldDescriptor::CPPTYPE_INT32;
    if (!is_number || field.is_repeated() || !rules.has_minimum() || !rules.has_maximum()) continue;
    const std::string unit = rules.counts().empty() ? unit_of(field.name()) : rules.counts();
    lines[at] = fmt::format("{{\"{}\", {{{}, {}, {}}}, \"{}{}\"}},\n", at, rules.minimum(), rules.maximum(),
                            rules.below(), unit.empty() ? "" : " ", unit);
  }
}

}  // namespace

std::string make_field_limits() {
  std::map<std::string, std::string> lines;
  list_limits(*find_proto("case").FindMessageTypeByName("Case"), "", lines);
  std::string out =
      "// Made from the options of case.proto: CELLCRUSH_WRITE_PAGES=1 build/ci/bin/proto_pages_test rewrites this.\n";
  for (const auto& [path, line] : lines) out += line;
  return out;
}

std::string make_fields_page() {
  const std::vector<Group> groups = find_groups(find_proto("case").FindMessageTypeByName("Case"));
  std::string out = kFieldsHead;
  for (const Group& group : groups) out += section_of(group, groups);
  return out;
}

}  // namespace cellcrush::docs
