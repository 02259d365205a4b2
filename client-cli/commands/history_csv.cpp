#include "commands/history_csv.h"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using google::protobuf::FieldDescriptor;

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

void append_value(const v1::Sample& sample, const Column& column, std::string& text) {
  const google::protobuf::Message* message = &sample;
  if (column.is_of_front) message = &sample.front();
  const auto& reflection = *message->GetReflection();
  if (column.field->cpp_type() == FieldDescriptor::CPPTYPE_INT64)
    fmt::format_to(std::back_inserter(text), "{}", reflection.GetInt64(*message, column.field));
  else if (!column.is_of_front || sample.has_front())
    fmt::format_to(std::back_inserter(text), "{}", reflection.GetDouble(*message, column.field));
}

}  // namespace

std::string history_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples) {
  const auto columns = make_columns();
  std::string text;
  for (const Column& column : columns) text += (text.empty() ? "" : ",") + column.name;
  text += '\n';
  for (const v1::Sample& sample : samples) {
    const char* separator = "";
    for (const Column& column : columns) {
      text += separator;
      append_value(sample, column, text);
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

std::string nodes_signature() { return "time_s,node,ux_mm,uy_mm,rotation_rad"; }

std::string nodes_header() { return nodes_signature() + ",reaction_x_n,reaction_y_n,reaction_moment_n_mm"; }

std::string nodes_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples) {
  std::string text;
  for (const v1::Sample& sample : samples) {
    for (const v1::WatchedNode& node : sample.watched()) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", sample.time_s(), csv_cell(node.node()),
                     node.ux_mm(), node.uy_mm(), node.rotation_rad(), node.reaction_x_n(), node.reaction_y_n(),
                     node.reaction_moment_n_mm());
    }
  }
  return text.empty() ? text : nodes_header() + '\n' + text;
}

std::string rigid_walls_header() { return "time_s,wall,displacement_mm,normal_force_n,tangential_force_n"; }

std::string rigid_walls_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples) {
  std::string text;
  for (const v1::Sample& sample : samples) {
    for (const v1::RigidWallSample& wall : sample.rigid_walls()) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", sample.time_s(), csv_cell(wall.wall()),
                     wall.displacement_mm(), wall.normal_force_n(), wall.tangential_force_n());
    }
  }
  return text.empty() ? text : rigid_walls_header() + '\n' + text;
}

std::string frame_header() { return "element,x0_mm,y0_mm,x1_mm,y1_mm,thickness_mm,plastic_fraction"; }

std::string frame_csv(const MeshFrame& frame) {
  std::string text = frame_header() + '\n';
  for (int element = 0; element < frame.mesh.thickness_mm_size(); ++element) {
    const int start = 2 * frame.mesh.element_nodes(2 * element);
    const int end = 2 * frame.mesh.element_nodes(2 * element + 1);
    const auto& position = frame.frame.position_mm();
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", element, position[start], position[start + 1],
                   position[end], position[end + 1], frame.mesh.thickness_mm(element),
                   frame.frame.plastic_fraction(element));
  }
  return text;
}

}  // namespace cellcrush::client
