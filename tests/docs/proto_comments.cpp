#include "docs/proto_comments.h"

#include <google/protobuf/descriptor.pb.h>

#include <fstream>
#include <stdexcept>

#include "chart/display_text.h"

namespace cellcrush::docs {

namespace pb = google::protobuf;

namespace {

const std::string kPackage = "cellcrush.v1.";

std::string base_type(const pb::FieldDescriptor& field) {
  const std::string named = type_name(field);
  return named.empty() ? field.type_name() : named;
}

}  // namespace

const pb::DescriptorPool& commented_protos() {
  static const pb::DescriptorPool* const kPool = [] {
    pb::FileDescriptorSet files;
    std::ifstream stream(CELLCRUSH_DESCRIPTORS, std::ios::binary);
    if (!files.ParseFromIstream(&stream)) throw std::runtime_error(CELLCRUSH_DESCRIPTORS " cannot be read");
    auto* built = new pb::DescriptorPool();
    for (const auto& file : files.file()) built->BuildFile(file);
    return built;
  }();
  return *kPool;
}

const pb::FileDescriptor& find_proto(const std::string& name) {
  const auto* file = commented_protos().FindFileByName("cellcrush/v1/" + name + ".proto");
  if (file == nullptr) throw std::runtime_error("there is no " + name + ".proto");
  return *file;
}

std::string short_name(const std::string& full_name) {
  return full_name.starts_with(kPackage) ? full_name.substr(kPackage.size()) : full_name;
}

std::string type_name(const pb::FieldDescriptor& field) {
  if (field.is_map()) return type_name(*field.message_type()->map_value());
  if (field.message_type() != nullptr) return short_name(field.message_type()->full_name());
  return field.enum_type() != nullptr ? short_name(field.enum_type()->full_name()) : "";
}

std::string type_text(const pb::FieldDescriptor& field) {
  if (field.is_map()) {
    const auto& entry = *field.message_type();
    return "map<" + base_type(*entry.map_key()) + ", " + base_type(*entry.map_value()) + ">";
  }
  return (field.is_repeated() ? "repeated " : "") + base_type(field);
}

std::string cell(const std::string& text) {
  std::string out;
  for (const char character : text) {
    if (character == '|') out += '\\';
    const bool is_space = character == '\n' || character == ' ';
    if (!is_space) out += character;
    if (is_space && !out.empty() && out.back() != ' ') out += ' ';
  }
  return out;
}

std::string paragraph(const std::string& text) {
  constexpr int kColumns = 118;
  return client::wrap_text(text, kColumns) + "\n";
}

std::string link(const std::string& text, const std::string& target) { return "[" + text + "](" + target + ")"; }

}  // namespace cellcrush::docs
