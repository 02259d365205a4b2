#include "columns/history_csv.h"

#include <vector>

namespace cellcrush {

namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

struct Column {
  std::string name;
  const FieldDescriptor* field;
  bool is_of_front;
};

void add_columns(const google::protobuf::Descriptor& message, FieldDescriptor::CppType type, const std::string& prefix,
                 std::vector<Column>& out) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor* field = message.field(i);
    if (!field->is_repeated() && field->cpp_type() == type)
      out.push_back({prefix + std::string(field->name()), field, !prefix.empty()});
  }
}

// Every number of a sample and its front; the counts last.
std::vector<Column> make_columns() {
  std::vector<Column> out;
  add_columns(*v1::Sample::descriptor(), FieldDescriptor::CPPTYPE_DOUBLE, "", out);
  add_columns(*v1::Front::descriptor(), FieldDescriptor::CPPTYPE_DOUBLE, "front_", out);
  add_columns(*v1::Sample::descriptor(), FieldDescriptor::CPPTYPE_INT64, "", out);
  return out;
}

void add_value(const v1::Sample& sample, const Column& column, CsvText& text) {
  if (column.is_of_front && !sample.has_front()) return text.add(std::string_view());
  const Message& message = column.is_of_front ? static_cast<const Message&>(sample.front()) : sample;
  const auto& reflection = *message.GetReflection();
  if (column.field->cpp_type() == FieldDescriptor::CPPTYPE_INT64)
    text.add(static_cast<std::int64_t>(reflection.GetInt64(message, column.field)));
  else
    text.add(reflection.GetDouble(message, column.field));
}

// One line per part and sample: the time, then every field of the part.
template <class PartsOf>
std::string parts_csv(const Samples& samples, PartsOf parts_of, Decimal decimal) {
  CsvText text(decimal);
  bool has_header = false;
  for (const v1::Sample& sample : samples) {
    for (const Message& part : parts_of(sample)) {
      const auto& type = *part.GetDescriptor();
      if (!has_header) {
        text.add("time_s");
        for (int i = 0; i < type.field_count(); ++i) text.add(type.field(i)->name());
        text.end_row();
        has_header = true;
      }
      text.add(sample.time_s());
      text.add(part.GetReflection()->GetString(part, type.field(0)));
      for (int i = 1; i < type.field_count(); ++i) text.add(part.GetReflection()->GetDouble(part, type.field(i)));
      text.end_row();
    }
  }
  return text.take();
}

}  // namespace

std::string history_csv(const Samples& samples, Decimal decimal, bool with_header) {
  static const auto kColumns = make_columns();
  CsvText text(decimal);
  if (with_header) {
    for (const Column& column : kColumns) text.add(column.name);
    text.end_row();
  }
  for (const v1::Sample& sample : samples) {
    for (const Column& column : kColumns) add_value(sample, column, text);
    text.end_row();
  }
  return text.take();
}

std::string nodes_csv(const Samples& samples, Decimal decimal) {
  return parts_csv(
      samples, [](const v1::Sample& sample) -> const auto& { return sample.watched(); }, decimal);
}

std::string rigid_walls_csv(const Samples& samples, Decimal decimal) {
  return parts_csv(
      samples, [](const v1::Sample& sample) -> const auto& { return sample.rigid_walls(); }, decimal);
}

std::string grips_csv(const Samples& samples, Decimal decimal) {
  return parts_csv(
      samples, [](const v1::Sample& sample) -> const auto& { return sample.grips(); }, decimal);
}

std::string frame_csv(const v1::Mesh& mesh, const v1::FieldFrame& frame, Decimal decimal) {
  CsvText text(decimal);
  for (const char* name : {"element", "x0_mm", "y0_mm", "x1_mm", "y1_mm", "thickness_mm", "plastic_fraction"})
    text.add(name);
  text.end_row();
  for (int element = 0; element < mesh.thickness_mm_size(); ++element) {
    text.add(std::int64_t{element});
    for (const int end : {2 * mesh.element_nodes(2 * element), 2 * mesh.element_nodes(2 * element + 1)}) {
      text.add(frame.position_mm(end));
      text.add(frame.position_mm(end + 1));
    }
    text.add(mesh.thickness_mm(element));
    text.add(frame.plastic_fraction(element));
    text.end_row();
  }
  return text.take();
}

}  // namespace cellcrush
