#include "case_file/field_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "cellcrush/v1/case.pb.h"
#include "usage/suggestion.h"

namespace cellcrush::client {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;

void collect_enums(const Descriptor& type, std::string_view field, std::set<const Descriptor*>& seen,
                   std::set<const EnumDescriptor*>& found) {
  if (!seen.insert(&type).second) return;
  for (int i = 0; i < type.field_count(); ++i) {
    const auto* member = type.field(i);
    if (member->name() == field && member->enum_type() != nullptr) found.insert(member->enum_type());
    if (member->message_type() != nullptr) collect_enums(*member->message_type(), field, seen, found);
  }
}

void append_paths(const Descriptor& type, const std::string& prefix, std::vector<std::string>& paths) {
  for (int i = 0; i < type.field_count(); ++i) {
    const auto& field = *type.field(i);
    paths.push_back(prefix + field.name());
    if (field.message_type() != nullptr) append_paths(*field.message_type(), paths.back() + ".", paths);
  }
}

std::string name_of(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// The path with the fewest groups to a field of this name, the first of several; empty if there is none.
std::string find_path_to(std::string_view field) {
  const auto groups_of = [](const std::string& path) { return std::ranges::count(path, '.'); };
  std::string shortest;
  for (const std::string& path : case_paths()) {
    if (name_of(path) == field && (shortest.empty() || groups_of(path) < groups_of(shortest))) shortest = path;
  }
  return shortest;
}

// The field of a case, or the path to it, that a name stands for that `type` does not have; empty if none is near.
std::string find_meant(std::string_view field, const std::vector<std::string>& names) {
  if (std::string path = find_path_to(field); !path.empty()) return path;
  if (std::string nearest = find_nearest(field, names); !nearest.empty()) return nearest;
  constexpr std::size_t kTelling = 5;  // letters; shorter names are near to many others
  if (field.size() < kTelling) return {};
  std::vector<std::string> all;
  for (const std::string& path : case_paths()) all.push_back(name_of(path));
  return find_path_to(find_nearest(field, all));
}

}  // namespace

std::vector<std::string> case_paths() {
  std::vector<std::string> paths;
  append_paths(*v1::Case::descriptor(), "", paths);
  return paths;
}

std::vector<std::string> field_names(const google::protobuf::Descriptor& type) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(type.field_count()));
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

std::string unknown_field_message(std::string_view field, const google::protobuf::Descriptor& type) {
  const std::vector<std::string> names = field_names(type);
  const std::string nearest = find_meant(field, names);
  const std::string message = fmt::format("{} has no field \"{}\"", type.name(), field);
  if (nearest == field) return message + "; it is a field of the case itself: write it outside of all braces";
  return nearest.empty() ? fmt::format("{}; it has: {}. A field of a newer server needs the cellcrush of its version",
                                       message, fmt::join(names, ", "))
                         : with_suggestion(message, nearest);
}

std::string unknown_enum_message(std::string_view value, const google::protobuf::EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) names.push_back(type.value(i)->name());
  }
  return fmt::format("\"{}\" is not one of {}", value, fmt::join(names, ", "));
}

const google::protobuf::EnumValueDescriptor* find_enum_value(std::string_view name, const EnumDescriptor& type) {
  std::string capitals(name);
  for (char& letter : capitals) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return type.FindValueByName(capitals);
}

const EnumDescriptor* find_enum_of_field(std::string_view field) {
  std::set<const Descriptor*> seen;
  std::set<const EnumDescriptor*> found;
  collect_enums(*v1::Case::descriptor(), field, seen, found);
  return found.size() == 1 ? *found.begin() : nullptr;
}

std::vector<PathPart> split_path(std::string_view path) {
  std::vector<PathPart> parts;
  while (true) {
    const std::size_t dot = path.find('.');
    const std::string text(path.substr(0, dot));
    const std::size_t bracket = std::min(text.find('['), text.size());
    const bool is_closed = bracket < text.size() && text.ends_with(']');
    parts.push_back({text, text.substr(0, bracket),
                     is_closed ? text.substr(bracket + 1, text.size() - bracket - 2) : std::string()});
    if (dot == std::string_view::npos) return parts;
    path.remove_prefix(dot + 1);
  }
}

}  // namespace cellcrush::client
