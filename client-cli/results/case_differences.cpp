#include "results/case_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "results/field_value.h"

namespace cellcrush::client {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

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

bool is_path_character(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '_' || letter == '.' ||
         letter == '[' || letter == ']';
}

}  // namespace

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
    const std::string value = field_value_text(scene, field);
    if (value.empty()) continue;
    const FieldWords words = words_among(field, fields);
    text += fmt::format("{}{} = {}{}{}", text.empty() ? "" : ", ", words.name, value, words.unit.empty() ? "" : " ",
                        words.unit);
  }
  return text;
}

}  // namespace cellcrush::client
