#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::store {

/// A column of /history: the name of its dataset and its field of the sample. A missing value is NaN.
struct HistoryColumn {
  const char* name;
  double (*get)(const v1::Sample& sample);
  void (*set)(v1::Sample& sample, double value);
};

/// The column of a field of the sample itself.
template <double (v1::Sample::*kGet)() const, void (v1::Sample::*kSet)(double)>
constexpr HistoryColumn sample_column(const char* name) {
  return {name, [](const v1::Sample& sample) { return (sample.*kGet)(); },
          [](v1::Sample& sample, double value) { (sample.*kSet)(value); }};
}

/// The column of a field of the sample's front, which may be absent.
template <double (v1::Front::*kGet)() const, void (v1::Front::*kSet)(double)>
constexpr HistoryColumn front_column(const char* name) {
  return {name,
          [](const v1::Sample& sample) {
            return sample.has_front() ? (sample.front().*kGet)() : std::numeric_limits<double>::quiet_NaN();
          },
          [](v1::Sample& sample, double value) {
            if (!std::isnan(value)) (sample.mutable_front()->*kSet)(value);
          }};
}

/// All columns of /history, documented in result_format.md.
inline constexpr std::array<HistoryColumn, 25> kHistoryColumns = {{
    sample_column<&v1::Sample::time_s, &v1::Sample::set_time_s>("time_s"),
    sample_column<&v1::Sample::travel_mm, &v1::Sample::set_travel_mm>("travel_mm"),
    sample_column<&v1::Sample::strain, &v1::Sample::set_strain>("strain"),
    sample_column<&v1::Sample::stress_impact_mpa, &v1::Sample::set_stress_impact_mpa>("stress_impact_mpa"),
    sample_column<&v1::Sample::stress_support_mpa, &v1::Sample::set_stress_support_mpa>("stress_support_mpa"),
    sample_column<&v1::Sample::energy_kinetic_mj, &v1::Sample::set_energy_kinetic_mj>("energy_kinetic_mj"),
    sample_column<&v1::Sample::energy_elastic_mj, &v1::Sample::set_energy_elastic_mj>("energy_elastic_mj"),
    sample_column<&v1::Sample::energy_plastic_mj, &v1::Sample::set_energy_plastic_mj>("energy_plastic_mj"),
    sample_column<&v1::Sample::energy_contact_mj, &v1::Sample::set_energy_contact_mj>("energy_contact_mj"),
    sample_column<&v1::Sample::energy_friction_mj, &v1::Sample::set_energy_friction_mj>("energy_friction_mj"),
    sample_column<&v1::Sample::energy_damping_mj, &v1::Sample::set_energy_damping_mj>("energy_damping_mj"),
    sample_column<&v1::Sample::work_external_mj, &v1::Sample::set_work_external_mj>("work_external_mj"),
    sample_column<&v1::Sample::energy_residual_mj, &v1::Sample::set_energy_residual_mj>("energy_residual_mj"),
    sample_column<&v1::Sample::energy_contact_stored_mj, &v1::Sample::set_energy_contact_stored_mj>(
        "energy_contact_stored_mj"),
    sample_column<&v1::Sample::energy_contact_damping_mj, &v1::Sample::set_energy_contact_damping_mj>(
        "energy_contact_damping_mj"),
    sample_column<&v1::Sample::deepest_penetration, &v1::Sample::set_deepest_penetration>("deepest_penetration"),
    sample_column<&v1::Sample::solid_fraction, &v1::Sample::set_solid_fraction>("solid_fraction"),
    sample_column<&v1::Sample::collapsed_fraction, &v1::Sample::set_collapsed_fraction>("collapsed_fraction"),
    front_column<&v1::Front::position_mm, &v1::Front::set_position_mm>("front_position_mm"),
    front_column<&v1::Front::strain_behind, &v1::Front::set_strain_behind>("front_strain_behind"),
    front_column<&v1::Front::strain_ahead, &v1::Front::set_strain_ahead>("front_strain_ahead"),
    front_column<&v1::Front::velocity_behind_m_per_s, &v1::Front::set_velocity_behind_m_per_s>(
        "front_velocity_behind_m_per_s"),
    front_column<&v1::Front::velocity_ahead_m_per_s, &v1::Front::set_velocity_ahead_m_per_s>(
        "front_velocity_ahead_m_per_s"),
    front_column<&v1::Front::solid_fraction_behind, &v1::Front::set_solid_fraction_behind>(
        "front_solid_fraction_behind"),
    front_column<&v1::Front::wall_fraction_behind, &v1::Front::set_wall_fraction_behind>("front_wall_fraction_behind"),
}};

/// Rows per chunk of /history; the writer buffers as many.
inline constexpr int kHistoryChunkRows = 256;

/// Maximum number of particles or elements in a chunk of a frame.
inline constexpr int kFrameChunkItems = 65536;

}  // namespace cellcrush::store
