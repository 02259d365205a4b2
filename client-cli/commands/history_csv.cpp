#include "commands/history_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <iterator>
#include <optional>

#include "terminal/table.h"

namespace cellcrush::client {

namespace {

struct Column {
  const char* name;
  std::optional<double> (*value)(const v1::Sample& sample);
};

template <double (v1::Sample::*kGet)() const>
constexpr Column sample_column(const char* name) {
  return {name, [](const v1::Sample& sample) { return std::optional((sample.*kGet)()); }};
}

template <double (v1::Front::*kGet)() const>
constexpr Column front_column(const char* name) {
  return {name, [](const v1::Sample& sample) {
            return sample.has_front() ? std::optional((sample.front().*kGet)()) : std::nullopt;
          }};
}

constexpr std::array kColumns = {
    sample_column<&v1::Sample::time_s>("time_s"),
    sample_column<&v1::Sample::travel_mm>("travel_mm"),
    sample_column<&v1::Sample::strain>("strain"),
    sample_column<&v1::Sample::stress_impact_mpa>("stress_impact_mpa"),
    sample_column<&v1::Sample::stress_support_mpa>("stress_support_mpa"),
    sample_column<&v1::Sample::energy_kinetic_mj>("energy_kinetic_mj"),
    sample_column<&v1::Sample::energy_elastic_mj>("energy_elastic_mj"),
    sample_column<&v1::Sample::energy_plastic_mj>("energy_plastic_mj"),
    sample_column<&v1::Sample::energy_contact_mj>("energy_contact_mj"),
    sample_column<&v1::Sample::energy_friction_mj>("energy_friction_mj"),
    sample_column<&v1::Sample::energy_damping_mj>("energy_damping_mj"),
    sample_column<&v1::Sample::work_external_mj>("work_external_mj"),
    sample_column<&v1::Sample::energy_residual_mj>("energy_residual_mj"),
    sample_column<&v1::Sample::energy_contact_stored_mj>("energy_contact_stored_mj"),
    sample_column<&v1::Sample::energy_contact_damping_mj>("energy_contact_damping_mj"),
    sample_column<&v1::Sample::deepest_penetration>("deepest_penetration"),
    sample_column<&v1::Sample::solid_fraction>("solid_fraction"),
    sample_column<&v1::Sample::collapsed_fraction>("collapsed_fraction"),
    front_column<&v1::Front::position_mm>("front_position_mm"),
    front_column<&v1::Front::strain_behind>("front_strain_behind"),
    front_column<&v1::Front::strain_ahead>("front_strain_ahead"),
    front_column<&v1::Front::velocity_behind_m_per_s>("front_velocity_behind_m_per_s"),
    front_column<&v1::Front::velocity_ahead_m_per_s>("front_velocity_ahead_m_per_s"),
    front_column<&v1::Front::solid_fraction_behind>("front_solid_fraction_behind"),
    front_column<&v1::Front::wall_fraction_behind>("front_wall_fraction_behind"),
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
      text += separator;
      if (const auto value = column.value(sample)) fmt::format_to(std::back_inserter(text), "{}", *value);
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
