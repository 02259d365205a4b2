#include "results/field_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string>

#include "case_file/field_names.h"
#include "cellcrush/v1/field.pb.h"
#include "columns/field_text.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

using google::protobuf::FieldDescriptor;

namespace {

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

using google::protobuf::Descriptor;

// Paths of all fields outside of lists.
void collect_paths(const Descriptor& message, const std::string& prefix, std::vector<std::string>& paths) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor& field = *message.field(i);
    if (field.is_repeated()) continue;
    const std::string path = prefix + field.name();
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      collect_paths(*field.message_type(), path + '.', paths);
    } else {
      paths.push_back(path);
    }
  }
}

// The default of a field, without the note in brackets; empty if it has none, or belongs to another member of a oneof
// than the case has.
std::string default_text(const v1::Case& scene, std::string_view path) {
  const google::protobuf::Message* message = &scene;
  const FieldDescriptor* field = nullptr;
  const Descriptor* type = v1::Case::descriptor();
  for (const PathPart& part : split_path(path)) {
    field = type == nullptr ? nullptr : type->FindFieldByName(part.name);
    if (field == nullptr || field->is_repeated()) return {};
    const bool is_there = message != nullptr && message->GetReflection()->HasField(*message, field);
    if (field->real_containing_oneof() != nullptr && !is_there) return {};
    type = field->message_type();
    message = is_there && type != nullptr ? &message->GetReflection()->GetMessage(*message, field) : nullptr;
  }
  const std::string& rules = field->options().GetExtension(v1::rules).default_();
  return rules.substr(0, rules.find(" ("));
}

bool is_path_character(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '_' || letter == '.' ||
         letter == '[' || letter == ']';
}

}  // namespace

std::string field_value_text(const v1::Case& scene, std::string_view path) {
  const google::protobuf::Message* message = &scene;
  const std::vector<PathPart> parts = split_path(path);
  for (std::size_t i = 0; message != nullptr; ++i) {
    const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(parts[i].name);
    const bool is_last = i + 1 == parts.size();
    if (field == nullptr || (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) == is_last) return {};
    if (!is_last) {
      message = find_message(*message, *field, parts[i].index);
      continue;
    }
    const bool is_there =
        !field->is_repeated() && !parts[i].has_index() && message->GetReflection()->HasField(*message, field);
    return is_there ? scalar_text(*message, *field) : std::string();
  }
  return {};
}

std::string short_value_text(const v1::Case& scene, std::string_view path) {
  const std::string text = field_value_text(scene, path);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size() && !text.empty() ? short_text(value) : text;
}

FieldWords words_of(std::string_view path) {
  FieldWords words{std::string(path.substr(path.rfind('.') + 1)), {}};
  const auto [suffix, unit] = find_unit(words.name);
  words.name.resize(words.name.size() - std::min(suffix.size(), words.name.size()));
  for (const char letter : unit) words.unit += letter == '2' ? "²" : letter == '3' ? "³" : std::string(1, letter);
  std::replace(words.name.begin(), words.name.end(), '_', ' ');
  if (path == "elements_per_wall") words.name += " or beam";  // of a frame
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

std::string equation_text(std::string_view path, const std::string& value, const std::vector<std::string>& others) {
  const FieldWords words = words_among(path, others);
  return fmt::format("{} = {}{}{}", words.name, value, words.unit.empty() ? "" : " ", words.unit);
}

void append_words(const std::vector<std::string>& fields, std::vector<std::string>& names,
                  std::vector<std::string>& units) {
  for (const std::string& field : fields) {
    const FieldWords words = words_among(field, fields);
    names.push_back(words.name);
    units.push_back(words.unit);
  }
}

std::string base_title(const std::string& title) {
  std::string base = title;
  while (true) {
    const std::size_t comma = base.rfind(", ");
    const std::size_t equals = base.rfind(" = ");
    if (comma == std::string::npos || equals == std::string::npos || equals < comma + 2) return base;
    const bool path = std::all_of(base.begin() + static_cast<std::ptrdiff_t>(comma + 2),
                                  base.begin() + static_cast<std::ptrdiff_t>(equals), is_path_character);
    if (!path) return base;
    base.resize(comma);
  }
}

std::vector<std::string> find_differences(const std::vector<const v1::Case*>& cases) {
  static const std::vector<std::string> kPaths = [] {
    std::vector<std::string> paths;
    collect_paths(*v1::Case::descriptor(), "", paths);
    return paths;
  }();
  std::vector<std::string> differences;
  for (const std::string& path : kPaths) {
    const auto differs = [&](const v1::Case* scene) {
      return field_value_text(*scene, path) != field_value_text(*cases.front(), path);
    };
    if (path != "title" && std::any_of(cases.begin(), cases.end(), differs)) differences.push_back(path);
  }
  return differences;
}

std::vector<std::string> find_varied_fields(const std::vector<const v1::Case*>& cases) {
  std::map<std::string, std::vector<const v1::Case*>> groups;
  for (const v1::Case* scene : cases) groups[base_title(scene->title())].push_back(scene);
  std::map<std::string, std::size_t> uses;
  for (const auto& [title, group] : groups) {
    for (const std::string& field : find_differences(group)) uses[field] += group.size();
  }
  std::vector<std::string> fields;
  fields.reserve(uses.size());
  for (const auto& [field, count] : uses) fields.push_back(field);
  std::stable_sort(fields.begin(), fields.end(),
                   [&](const std::string& a, const std::string& b) { return uses[a] > uses[b]; });
  return fields;
}

std::string field_values_text(const v1::Case& scene, const std::vector<std::string>& fields) {
  std::string text;
  for (const std::string& field : fields) {
    std::string value = short_value_text(scene, field);
    if (value.empty()) value = default_text(scene, field);
    if (value.empty()) continue;
    const bool is_words = value.find_first_of("abcdfghijklmnopqrstuvwxyz") != std::string::npos;
    const bool is_of_beams = field == "elements_per_wall" && scene.lattice().has_frame();
    text += text.empty() ? "" : ", ";
    if (is_words) {
      text += words_among(field, fields).name + " by default";
    } else {
      text += is_of_beams ? "elements per beam = " + value : equation_text(field, value, fields);
    }
  }
  return text;
}

}  // namespace cellcrush::client
