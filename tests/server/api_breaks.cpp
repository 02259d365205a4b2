#include "server/api_breaks.h"

namespace cellcrush::testing {
namespace {

namespace pb = google::protobuf;

class Comparison {
 public:
  explicit Comparison(const pb::DescriptorPool& now) : now_(now) {}

  void compare(const pb::FileDescriptor& file) {
    for (int i = 0; i < file.message_type_count(); ++i) compare(*file.message_type(i));
    for (int i = 0; i < file.enum_type_count(); ++i) compare(*file.enum_type(i));
    for (int i = 0; i < file.service_count(); ++i) compare(*file.service(i));
  }

  std::vector<std::string> breaks;

 private:
  void add(const std::string& what, const std::string& why) { breaks.push_back(what + " " + why + "."); }

  void compare(const pb::Descriptor& before) {
    const auto* after = now_.FindMessageTypeByName(before.full_name());
    if (after == nullptr) return add(before.full_name(), "is gone");
    for (int i = 0; i < before.field_count(); ++i) compare(*before.field(i), *after);
    for (int i = 0; i < before.nested_type_count(); ++i) compare(*before.nested_type(i));
    for (int i = 0; i < before.enum_type_count(); ++i) compare(*before.enum_type(i));
  }

  void compare(const pb::FieldDescriptor& before, const pb::Descriptor& message) {
    const auto* after = message.FindFieldByNumber(before.number());
    if (after == nullptr) {
      if (!message.IsReservedNumber(before.number())) add(before.full_name(), "is gone, and its number not reserved");
      return;
    }
    if (after->name() != before.name()) add(before.full_name(), "is called " + after->name());
    if (type_of(*after) != type_of(before)) add(before.full_name(), "has type " + type_of(*after));
    if (oneof_of(*after) != oneof_of(before)) add(before.full_name(), "is in another oneof");
  }

  void compare(const pb::EnumDescriptor& before) {
    const auto* after = now_.FindEnumTypeByName(before.full_name());
    if (after == nullptr) return add(before.full_name(), "is gone");
    for (int i = 0; i < before.value_count(); ++i) {
      const auto& value = *before.value(i);
      const auto* same = after->FindValueByNumber(value.number());
      if (same == nullptr && !after->IsReservedNumber(value.number()))
        add(value.full_name(), "is gone, and its number not reserved");
      if (same != nullptr && same->name() != value.name()) add(value.full_name(), "is called " + same->name());
    }
  }

  void compare(const pb::ServiceDescriptor& before) {
    const auto* service = now_.FindServiceByName(before.full_name());
    if (service == nullptr) return add(before.full_name(), "is gone");
    for (int i = 0; i < before.method_count(); ++i) {
      const auto& method = *before.method(i);
      const auto* after = service->FindMethodByName(method.name());
      if (after == nullptr) {
        add(method.full_name(), "is gone");
      } else if (signature_of(*after) != signature_of(method)) {
        add(method.full_name(), "is now " + signature_of(*after));
      }
    }
  }

  static std::string type_of(const pb::FieldDescriptor& field) {
    std::string out = field.is_repeated() ? "repeated " : field.has_optional_keyword() ? "optional " : "";
    if (field.message_type() != nullptr) return out + field.message_type()->full_name();
    if (field.enum_type() != nullptr) return out + field.enum_type()->full_name();
    return out + field.type_name();
  }

  static std::string oneof_of(const pb::FieldDescriptor& field) {
    return field.real_containing_oneof() == nullptr ? "" : field.real_containing_oneof()->name();
  }

  static std::string signature_of(const pb::MethodDescriptor& method) {
    return std::string(method.client_streaming() ? "stream " : "") + method.input_type()->full_name() + " -> " +
           (method.server_streaming() ? "stream " : "") + method.output_type()->full_name();
  }

  const pb::DescriptorPool& now_;
};

}  // namespace

std::vector<std::string> api_breaks(const std::vector<const pb::FileDescriptor*>& old_files,
                                    const pb::DescriptorPool& now) {
  Comparison comparison(now);
  for (const auto* file : old_files) comparison.compare(*file);
  return comparison.breaks;
}

}  // namespace cellcrush::testing
