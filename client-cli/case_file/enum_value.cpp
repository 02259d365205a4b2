#include "case_file/enum_value.h"

#include <cctype>
#include <set>
#include <string>

#include "cellcrush/v1/case.pb.h"

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

}  // namespace

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

}  // namespace cellcrush::client
