#include "commands/history_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <iterator>

#include "terminal/csv_cell.h"

namespace cellcrush::client {

namespace {

struct Column {
  const char* name;
  double (v1::Sample::*value)() const;
};

constexpr std::array kColumns = {
    Column{"time_s", &v1::Sample::time_s},
    Column{"travel_mm", &v1::Sample::travel_mm},
    Column{"strain", &v1::Sample::strain},
    Column{"stress_impact_mpa", &v1::Sample::stress_impact_mpa},
    Column{"stress_support_mpa", &v1::Sample::stress_support_mpa},
    Column{"energy_kinetic_mj", &v1::Sample::energy_kinetic_mj},
    Column{"energy_elastic_mj", &v1::Sample::energy_elastic_mj},
    Column{"energy_plastic_mj", &v1::Sample::energy_plastic_mj},
    Column{"energy_contact_mj", &v1::Sample::energy_contact_mj},
    Column{"energy_friction_mj", &v1::Sample::energy_friction_mj},
    Column{"energy_damping_mj", &v1::Sample::energy_damping_mj},
    Column{"work_external_mj", &v1::Sample::work_external_mj},
    Column{"energy_residual_mj", &v1::Sample::energy_residual_mj},
    Column{"energy_contact_stored_mj", &v1::Sample::energy_contact_stored_mj},
    Column{"energy_contact_damping_mj", &v1::Sample::energy_contact_damping_mj},
    Column{"deepest_penetration", &v1::Sample::deepest_penetration},
};

}  // namespace

std::string history_header() {
  std::string header;
  for (const Column& column : kColumns) header += std::string(header.empty() ? "" : ",") + column.name;
  return header;
}

std::string history_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples) {
  std::string text = history_header() + '\n';
  for (const v1::Sample& sample : samples) {
    const char* separator = "";
    for (const Column& column : kColumns) {
      fmt::format_to(std::back_inserter(text), "{}{}", separator, (sample.*column.value)());
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

std::string nodes_header() { return "time_s,node,ux_mm,uy_mm,rotation_rad"; }

std::string nodes_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples) {
  std::string text;
  for (const v1::Sample& sample : samples) {
    for (const v1::WatchedNode& node : sample.watched()) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", sample.time_s(), csv_cell(node.node()), node.ux_mm(),
                     node.uy_mm(), node.rotation_rad());
    }
  }
  return text.empty() ? text : nodes_header() + '\n' + text;
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
