#pragma once

#include <array>

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::store {

/// A column of /history: its dataset's name and the field of the sample it holds.
struct HistoryColumn {
  const char* name;
  double (v1::Sample::*get)() const;
  void (v1::Sample::*set)(double);
};

/// All columns of /history; result_format.md says what they mean.
inline constexpr std::array<HistoryColumn, 16> kHistoryColumns = {{
    {"time_s", &v1::Sample::time_s, &v1::Sample::set_time_s},
    {"travel_mm", &v1::Sample::travel_mm, &v1::Sample::set_travel_mm},
    {"strain", &v1::Sample::strain, &v1::Sample::set_strain},
    {"stress_impact_mpa", &v1::Sample::stress_impact_mpa, &v1::Sample::set_stress_impact_mpa},
    {"stress_support_mpa", &v1::Sample::stress_support_mpa, &v1::Sample::set_stress_support_mpa},
    {"energy_kinetic_mj", &v1::Sample::energy_kinetic_mj, &v1::Sample::set_energy_kinetic_mj},
    {"energy_elastic_mj", &v1::Sample::energy_elastic_mj, &v1::Sample::set_energy_elastic_mj},
    {"energy_plastic_mj", &v1::Sample::energy_plastic_mj, &v1::Sample::set_energy_plastic_mj},
    {"energy_contact_mj", &v1::Sample::energy_contact_mj, &v1::Sample::set_energy_contact_mj},
    {"energy_friction_mj", &v1::Sample::energy_friction_mj, &v1::Sample::set_energy_friction_mj},
    {"energy_damping_mj", &v1::Sample::energy_damping_mj, &v1::Sample::set_energy_damping_mj},
    {"work_external_mj", &v1::Sample::work_external_mj, &v1::Sample::set_work_external_mj},
    {"energy_residual_mj", &v1::Sample::energy_residual_mj, &v1::Sample::set_energy_residual_mj},
    {"energy_contact_stored_mj", &v1::Sample::energy_contact_stored_mj, &v1::Sample::set_energy_contact_stored_mj},
    {"energy_contact_damping_mj", &v1::Sample::energy_contact_damping_mj, &v1::Sample::set_energy_contact_damping_mj},
    {"deepest_penetration", &v1::Sample::deepest_penetration, &v1::Sample::set_deepest_penetration},
}};

/// Rows of a chunk of /history, and rows that the writer gathers before it writes them.
inline constexpr int kHistoryChunkRows = 256;

/// Particles or elements in a chunk of a frame, at most.
inline constexpr int kFrameChunkItems = 65536;

}  // namespace cellcrush::store
