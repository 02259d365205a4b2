#include "store/result_layout.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace cellcrush::store {
namespace {

using google::protobuf::FieldDescriptor;

void add_columns(const google::protobuf::Descriptor& message, FieldDescriptor::CppType type, const std::string& prefix,
                 std::vector<HistoryColumn>& out) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor* field = message.field(i);
    if (field->is_repeated() || field->cpp_type() != type) continue;
    out.push_back(
        {prefix + std::string(field->name()), field, !prefix.empty(), type == FieldDescriptor::CPPTYPE_INT64});
  }
}

}  // namespace

double HistoryColumn::get(const v1::Sample& sample) const {
  if (is_of_front && !sample.has_front()) return std::numeric_limits<double>::quiet_NaN();
  if (is_of_front) return v1::Front::GetReflection()->GetDouble(sample.front(), field);
  const auto& reflection = *v1::Sample::GetReflection();
  return is_count ? static_cast<double>(reflection.GetInt64(sample, field)) : reflection.GetDouble(sample, field);
}

void HistoryColumn::set(v1::Sample& sample, double value) const {
  if (std::isnan(value)) return;
  const auto& reflection = *v1::Sample::GetReflection();
  if (is_of_front) {
    v1::Front::GetReflection()->SetDouble(sample.mutable_front(), field, value);
  } else if (is_count) {
    reflection.SetInt64(&sample, field, static_cast<std::int64_t>(value));
  } else {
    reflection.SetDouble(&sample, field, value);
  }
}

const std::vector<HistoryColumn>& history_columns() {
  static const std::vector<HistoryColumn> columns = [] {
    std::vector<HistoryColumn> out;
    add_columns(*v1::Sample::descriptor(), FieldDescriptor::CPPTYPE_DOUBLE, "", out);
    add_columns(*v1::Front::descriptor(), FieldDescriptor::CPPTYPE_DOUBLE, "front_", out);
    add_columns(*v1::Sample::descriptor(), FieldDescriptor::CPPTYPE_INT64, "", out);
    return out;
  }();
  return columns;
}

}  // namespace cellcrush::store
