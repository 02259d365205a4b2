#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <regex>

#include "case_file/case_source.h"
#include "case_file/field_names.h"
#include "command_error.h"

namespace cellcrush::client {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

// The field at the end of a path such as "lattice.frame.nodes[1].x_mm", or nullptr.
const FieldDescriptor* find_path(const std::string& path) {
  const Descriptor* type = v1::Case::descriptor();
  const FieldDescriptor* field = nullptr;
  for (const PathPart& part : split_path(path)) {
    if (type == nullptr) return nullptr;
    field = type->FindFieldByName(part.name);
    if (field == nullptr) field = type->FindFieldByCamelcaseName(part.name);
    if (field == nullptr) return nullptr;
    type = field->message_type();
  }
  return field;
}

const char* expected_value(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: return "expected a number";
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_UINT64: return "expected an integer";
    case FieldDescriptor::CPPTYPE_BOOL: return "expected true or false";
    case FieldDescriptor::CPPTYPE_STRING: return "expected a string in quotes";
    default: return "expected an object in braces";
  }
}

std::string explain_value(const std::string& path, const std::string& value, const std::string& message) {
  const FieldDescriptor* field = find_path(path);
  if (field == nullptr || message.find("oneof field") != std::string::npos) return message;
  if (field->enum_type() != nullptr) return unknown_enum_message(value, *field->enum_type());
  return fmt::format("{}, not {}", expected_value(*field), value);
}

// The library's message with the path in front, followed by what is expected or a suggestion.
std::string explain_json(const std::string& message) {
  static const std::regex kUnknownField(R"re((?:\(([^)]*)\) )?([^ ]*): Cannot find field\.)re");
  static const std::regex kBadValue(R"re(\(([^)]*)\): (invalid value "?([^"]*)"? for type .*))re");
  std::smatch match;
  if (std::regex_match(message, match, kUnknownField)) {
    const std::string group = match[1].str();
    const FieldDescriptor* parent = find_path(group);
    const Descriptor* type = group.empty()       ? v1::Case::descriptor()
                             : parent == nullptr ? nullptr
                                                 : parent->message_type();
    const std::string path = group + (group.empty() ? "" : ".") + match[2].str();
    return path + ": " + (type == nullptr ? "no such field" : unknown_field_message(match[2].str(), *type));
  }
  if (std::regex_match(message, match, kBadValue)) {
    return match[1].str() + ": " + explain_value(match[1].str(), match[3].str(), match[2].str());
  }
  const std::size_t begin = message.find_first_not_of(": ");
  return begin == std::string::npos ? message : message.substr(begin);
}

}  // namespace

v1::Case parse_json_case(const std::string& text, const std::string& file) {
  v1::Case result;
  google::protobuf::util::JsonParseOptions options;
  options.case_insensitive_enum_parsing = true;
  const auto status = google::protobuf::util::JsonStringToMessage(text, &result, options);
  if (!status.ok()) {
    refuse(fmt::format("the case cannot be read\n{}: {}", file, explain_json(std::string(status.message()))));
  }
  return result;
}

}  // namespace cellcrush::client
