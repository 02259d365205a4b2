#include "columns/field_text.h"

#include <google/protobuf/descriptor.pb.h>

#include <array>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cellcrush {

namespace {

// Longer suffixes first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kUnits = {{
    {"_mm_or_rad", "mm or rad"},
    {"_kg_per_m3", "kg/m3"},
    {"_n_or_n_mm", "N or N mm"},
    {"_rad_per_s", "rad/s"},
    {"_n_per_mm", "N/mm"},
    {"_m_per_s2", "m/s2"},
    {"_m_per_s", "m/s"},
    {"_degrees", "degrees"},
    {"_per_s", "1/s"},
    {"_g_mm2", "g mm2"},
    {"_n_mm", "N mm"},
    {"_rad", "rad"},
    {"_mpa", "MPa"},
    {"_mj", "mJ"},
    {"_mm", "mm"},
    {"_s", "s"},
    {"_g", "g"},
    {"_n", "N"},
}};

}  // namespace

FieldUnit find_unit(std::string_view field_name) {
  for (const auto& [suffix, unit] : kUnits) {
    if (field_name.ends_with(suffix) || field_name == suffix.substr(1)) return {suffix, unit};
  }
  return {};
}

std::string unit_of(std::string_view field_name) { return std::string(find_unit(field_name).unit); }

std::string join_comment(const std::string& lines) {
  std::istringstream stream(lines);
  std::string text;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) {
      text += "\n\n";
      continue;
    }
    if (!text.empty() && text.back() != '\n') text += ' ';
    text += line.substr(begin);
  }
  return text;
}

const google::protobuf::DescriptorPool& commented_protos() {
  static const google::protobuf::DescriptorPool* const kPool = [] {
    google::protobuf::FileDescriptorSet files;
    const std::string_view bytes = proto_descriptors();
    if (!files.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
      throw std::runtime_error("the embedded descriptors of the protos cannot be read");
    auto* built = new google::protobuf::DescriptorPool();
    for (const auto& file : files.file()) built->BuildFile(file);
    return built;
  }();
  return *kPool;
}

std::string meaning_of(const google::protobuf::FieldDescriptor& field) {
  constexpr std::string_view kOutputOnly = "Output only. ";
  const auto* commented = commented_protos().FindFieldByName(field.full_name());
  std::string text = commented == nullptr ? "" : comment_above(*commented);
  if (text.starts_with(kOutputOnly)) text.erase(0, kOutputOnly.size());
  return text;
}

}  // namespace cellcrush
