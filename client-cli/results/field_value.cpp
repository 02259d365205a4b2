#include "results/field_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace cellcrush::client {

using google::protobuf::FieldDescriptor;

std::string field_value_text(const v1::Case& scene, std::string_view path) {
  const google::protobuf::Message* message = &scene;
  while (true) {
    const std::size_t dot = path.find('.');
    const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(std::string(path.substr(0, dot)));
    const auto* reflection = message->GetReflection();
    if (field == nullptr || field->is_repeated() || !reflection->HasField(*message, field)) return {};
    const bool group = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    if (group != (dot != std::string_view::npos)) return {};
    if (!group) {
      switch (field->cpp_type()) {
        case FieldDescriptor::CPPTYPE_DOUBLE: return fmt::format("{}", reflection->GetDouble(*message, field));
        case FieldDescriptor::CPPTYPE_INT32: return std::to_string(reflection->GetInt32(*message, field));
        case FieldDescriptor::CPPTYPE_UINT64: return std::to_string(reflection->GetUInt64(*message, field));
        default: return {};
      }
    }
    message = &reflection->GetMessage(*message, field);
    path.remove_prefix(dot + 1);
  }
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

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('.') + 1); }

}  // namespace cellcrush::client
