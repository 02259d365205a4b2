#include "case_file/set_field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "case_file/field_names.h"
#include "case_file/typed_number.h"
#include "command_error.h"

namespace cellcrush::client {

namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

[[noreturn]] void refuse_path(std::string_view path, const std::string& message) {
  refuse(fmt::format("--set {}: {}", path, message));
}

// The place of an element in its list; -1 without one.
int index_of(const PathPart& part, std::string_view path) {
  int index = -1;
  if (part.has_index() && (!parse_plain(part.index, index) || index < 0)) {
    refuse_path(path, fmt::format("\"{}\" is not a list index; write {}[0], counting from 0", part.text, part.name));
  }
  return index;
}

const FieldDescriptor& find_field(const Message& message, const PathPart& part, std::string_view path) {
  const int index = index_of(part, path);
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(part.name);
  if (field == nullptr) refuse_path(path, unknown_field_message(part.name, *message.GetDescriptor()));
  if (field->is_repeated() && index < 0) {
    refuse_path(path, fmt::format("\"{0}\" is a list; name an element such as {0}[0], counting from 0", part.name));
  }
  if (!field->is_repeated() && index >= 0) refuse_path(path, fmt::format("\"{}\" is not a list", part.name));
  if (field->is_repeated()) {
    const int size = message.GetReflection()->FieldSize(message, field);
    if (index >= size) refuse_path(path, fmt::format("\"{}\" has {} elements in this case", part.name, size));
  }
  return *field;
}

void refuse_other_member(const Message& message, const FieldDescriptor& field, std::string_view path) {
  const auto* choice = field.real_containing_oneof();
  if (choice == nullptr) return;
  const FieldDescriptor* present = message.GetReflection()->GetOneofFieldDescriptor(message, choice);
  if (present == nullptr || present == &field) return;
  refuse_path(path,
              fmt::format("this case has {0} \"{1}\", so \"{2}\" cannot be set; start from a case with {0} \"{2}\"",
                          message.GetDescriptor()->name() == "Lattice" ? "the lattice" : "the field", present->name(),
                          field.name()));
}

template <typename Number>
Number number_or_refuse(std::string_view path, std::string_view value, std::string_view expected) {
  const TypedNumber typed = std::is_integral_v<Number> ? read_whole(value) : read_real(value);
  if (!typed.problem.empty()) refuse_path(path, fmt::format("\"{}\" {}", value, typed.problem));
  Number number{};
  if (!parse_plain(typed.plain, number)) refuse_path(path, fmt::format("\"{}\" is not {}", value, expected));
  return number;
}

void set_value(Message& message, const FieldDescriptor& field, int index, std::string_view path,
               std::string_view value) {
  const auto* reflection = message.GetReflection();
  const auto put = [&](auto set, auto set_element, const auto& parsed) {
    index < 0 ? (reflection->*set)(&message, &field, parsed)
              : (reflection->*set_element)(&message, &field, index, parsed);
  };
  using Reflection = google::protobuf::Reflection;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return put(&Reflection::SetDouble, &Reflection::SetRepeatedDouble,
                 number_or_refuse<double>(path, value, "a number"));
    case FieldDescriptor::CPPTYPE_INT32:
      return put(&Reflection::SetInt32, &Reflection::SetRepeatedInt32,
                 number_or_refuse<std::int32_t>(path, value, "a 32-bit integer, such as 12"));
    case FieldDescriptor::CPPTYPE_UINT64:
      return put(&Reflection::SetUInt64, &Reflection::SetRepeatedUInt64,
                 number_or_refuse<std::uint64_t>(path, value, "a non-negative integer, such as 12"));
    case FieldDescriptor::CPPTYPE_BOOL:
      if (value != "true" && value != "false")
        refuse_path(path, fmt::format("\"{}\" is neither true nor false", value));
      return put(&Reflection::SetBool, &Reflection::SetRepeatedBool, value == "true");
    case FieldDescriptor::CPPTYPE_STRING:
      return put(&Reflection::SetString, &Reflection::SetRepeatedString, std::string(value));
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto* parsed = find_enum_value(value, *field.enum_type());
      if (parsed == nullptr) refuse_path(path, unknown_enum_message(value, *field.enum_type()));
      return put(&Reflection::SetEnum, &Reflection::SetRepeatedEnum, parsed);
    }
    case FieldDescriptor::CPPTYPE_MESSAGE:
      refuse_path(path, fmt::format("\"{}\" is a group; set one of its fields: {}", field.name(),
                                    fmt::join(field_names(*field.message_type()), ", ")));
    default:
      refuse_path(path, fmt::format("a field of type {} cannot be set here; set it in a file", field.cpp_type_name()));
  }
}

}  // namespace

void set_field(v1::Case& target, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    refuse_path(assignment, "expected PATH=VALUE, such as loading.speed_m_per_s=100");
  }
  const std::string_view path = assignment.substr(0, equals);
  const std::vector<PathPart> parts = split_path(path);
  Message* message = &target;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const FieldDescriptor& field = find_field(*message, parts[i], path);
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
      refuse_path(path,
                  fmt::format("\"{}\" is a single value and has no field \"{}\"", field.name(), parts[i + 1].name));
    }
    refuse_other_member(*message, field, path);
    const auto* reflection = message->GetReflection();
    message = field.is_repeated() ? reflection->MutableRepeatedMessage(message, &field, index_of(parts[i], path))
                                  : reflection->MutableMessage(message, &field);
  }
  const FieldDescriptor& field = find_field(*message, parts.back(), path);
  refuse_other_member(*message, field, path);
  set_value(*message, field, index_of(parts.back(), path), path, assignment.substr(equals + 1));
}

}  // namespace cellcrush::client
