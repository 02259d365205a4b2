#include "help/case_manual.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <sstream>
#include <stdexcept>

#include "case_file/field_names.h"
#include "columns/field_text.h"
#include "command_error.h"
#include "help/field_rules.h"

namespace cellcrush::client {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

const Descriptor& case_type() { return *commented_protos().FindMessageTypeByName("cellcrush.v1.Case"); }

// The comment on a field, then that on its type, if any.
std::string comment_of(const FieldDescriptor& field) {
  std::string type;
  if (field.message_type() != nullptr) type = comment_above(*field.message_type());
  if (field.enum_type() != nullptr) type = comment_above(*field.enum_type());
  const std::string own = comment_above(field);
  return own.empty() || type.empty() ? own + type : own + "\n\n" + type;
}

std::string type_of(const FieldDescriptor& field) {
  std::string type = field.type_name();
  if (field.message_type() != nullptr) type += " " + field.message_type()->name();
  if (field.enum_type() != nullptr) type += " " + field.enum_type()->name();
  return field.is_repeated() ? "list of " + type : type;
}

std::vector<std::pair<std::string, std::string>> list_fields(const Descriptor& type) {
  std::vector<std::pair<std::string, std::string>> fields;
  fields.reserve(static_cast<std::size_t>(type.field_count()));
  for (int i = 0; i < type.field_count(); ++i) {
    fields.emplace_back(type.field(i)->name(), first_sentence(comment_of(*type.field(i))));
  }
  return fields;
}

const FieldDescriptor& find_in(const Descriptor& type, const std::string& name, const std::string& path) {
  const FieldDescriptor* field = type.FindFieldByName(name);
  if (field != nullptr) return *field;
  refuse(path + ": " + unknown_field_message(name, type));
}

const FieldDescriptor& find_field_at(const std::string& path) {
  const Descriptor* type = &case_type();
  const FieldDescriptor* field = nullptr;
  std::istringstream names(path);
  for (std::string name; std::getline(names, name, '.');) {
    if (type == nullptr) {
      refuse(fmt::format("{}: \"{}\" is a single value and has no field \"{}\"", path, field->name(), name));
    }
    field = &find_in(*type, name.substr(0, name.find('[')), path);
    type = field->message_type();
  }
  return *field;
}

}  // namespace

FieldManual find_field_manual(const std::string& path) {
  FieldManual manual;
  manual.path = path;
  if (path.empty()) {
    manual.type = "message Case";
    manual.comment = comment_above(case_type());
    manual.fields = list_fields(case_type());
    return manual;
  }
  const FieldDescriptor& field = find_field_at(path);
  manual.type = type_of(field);
  manual.unit = unit_of(field.name());
  manual.comment = comment_of(field);
  manual.default_value = default_of(field);
  manual.limits = limits_of(field);
  if (field.message_type() != nullptr) manual.fields = list_fields(*field.message_type());
  for (int i = 0; field.enum_type() != nullptr && i < field.enum_type()->value_count(); ++i) {
    const auto& value = *field.enum_type()->value(i);
    if (value.number() != 0) manual.values.emplace_back(value.name(), comment_above(value));
  }
  return manual;
}

}  // namespace cellcrush::client
