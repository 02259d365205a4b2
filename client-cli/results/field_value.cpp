#include "results/field_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace cellcrush::client {

using google::protobuf::FieldDescriptor;

namespace {

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('.') + 1); }

std::string scalar_text(const google::protobuf::Message& message, const FieldDescriptor& field) {
  const auto* reflection = message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: return fmt::format("{}", reflection->GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_INT32: return std::to_string(reflection->GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_UINT64: return std::to_string(reflection->GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_ENUM: return reflection->GetEnum(message, &field)->name();
    default: return {};
  }
}

// The message in a field, or in its list at `index` (digits); null if there is none.
const google::protobuf::Message* find_message(const google::protobuf::Message& message, const FieldDescriptor& field,
                                              const std::string& index) {
  const auto* reflection = message.GetReflection();
  if (!field.is_repeated()) {
    return index.empty() && reflection->HasField(message, &field) ? &reflection->GetMessage(message, &field) : nullptr;
  }
  if (index.empty() || index.size() > 6 || index.find_first_not_of("0123456789") != std::string::npos) return nullptr;
  const int at = std::stoi(index);
  return at < reflection->FieldSize(message, &field) ? &reflection->GetRepeatedMessage(message, &field, at) : nullptr;
}

}  // namespace

std::string field_value_text(const v1::Case& scene, std::string_view path) {
  const google::protobuf::Message* message = &scene;
  while (message != nullptr) {
    const std::size_t dot = path.find('.');
    std::string name(path.substr(0, dot));
    std::string index;
    if (const std::size_t bracket = name.find('['); bracket != std::string::npos && name.back() == ']') {
      index = name.substr(bracket + 1, name.size() - bracket - 2);
      name.resize(bracket);
    }
    const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(name);
    if (field == nullptr) return {};
    const bool group = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    if (group != (dot != std::string_view::npos)) return {};
    if (!group) {
      const bool there = !field->is_repeated() && index.empty() && message->GetReflection()->HasField(*message, field);
      return there ? scalar_text(*message, *field) : std::string();
    }
    message = find_message(*message, *field, index);
    path.remove_prefix(dot + 1);
  }
  return {};
}

FieldWords words_of(std::string_view path) {
  // Longer endings first: "_m_per_s" ends in "_s" too.
  constexpr std::array<std::pair<std::string_view, const char*>, 7> kUnits = {{{"_kg_per_m3", "kg/m³"},
                                                                               {"_m_per_s2", "m/s²"},
                                                                               {"_m_per_s", "m/s"},
                                                                               {"_per_s", "1/s"},
                                                                               {"_mpa", "MPa"},
                                                                               {"_mm", "mm"},
                                                                               {"_s", "s"}}};
  FieldWords words{std::string(last_part(path)), {}};
  for (const auto& [ending, unit] : kUnits) {
    if (!words.name.ends_with(ending)) continue;
    words.name.resize(words.name.size() - ending.size());
    words.unit = unit;
    break;
  }
  std::replace(words.name.begin(), words.name.end(), '_', ' ');
  return words;
}

FieldWords words_among(std::string_view path, const std::vector<std::string>& others) {
  FieldWords words = words_of(path);
  const bool taken = std::any_of(others.begin(), others.end(), [&](const std::string& other) {
    return other != path && words_of(other).name == words.name;
  });
  const std::size_t dot = path.rfind('.');
  if (taken && dot != std::string_view::npos) words.name = words_of(path.substr(0, dot)).name + ' ' + words.name;
  return words;
}

}  // namespace cellcrush::client
