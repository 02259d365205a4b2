#include "scene/contact_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "cellcrush/tuning.h"

namespace cellcrush {
namespace {

/// Penetration of a free particle at plate speed, as a fraction of the thickness of the thinnest wall (E9).
constexpr double kImpactDepth = 0.16;
/// Greatest phase angle omega dt of the lightest particle on its contact at a given step, rad; the 0.6 below E9.
constexpr double kMostPhase = 0.6;
/// Greatest travel in a step, as a fraction of the thinnest wall's thickness. At a given step a free particle sinks in
/// by the travel over kMostPhase: here by two thirds of the thickness.
constexpr double kMostTravel = 0.4;

/// Angular frequency sqrt(k / m_min) of the lightest particle on its contact, 1/s.
double contact_frequency(const SceneSpec& spec, const MeshMeasures& mesh) {
  const double of_mesh = std::sqrt(spec.contact.stiffness_factor) / mesh.steps.of_elements;
  const double of_impact = impact_speed_of(spec, mesh) / (kImpactDepth * mesh.thinnest_wall);
  const double step = spec.numerics.time_step_s;
  return std::max(of_mesh, step > 0.0 ? std::min(of_impact, kMostPhase / step) : of_impact);
}

}  // namespace

double impact_speed_of(const SceneSpec& spec, const MeshMeasures& mesh) {
  const double known = mesh.approach_speed + spec.loading.speed_m_per_s.value_or(0.0) * kMmPerM;
  return std::max(known, spec.contact.impact_speed_m_per_s * kMmPerM);
}

ContactLaw contact_law_of(const SceneSpec& spec, const MeshMeasures& mesh) {
  const double frequency = contact_frequency(spec, mesh);
  return {mesh.contact,
          mesh.lightest_mass * frequency * frequency,
          spec.contact.damping_ratio,
          spec.contact.friction,
          kSkinFraction * mesh.shortest_element,
          kFaceSkinFraction * mesh.shortest_element,
          mesh.thinnest_wall,
          mesh.contact && !is_driven_by_plates_alone(spec) ? kMostTravel * mesh.thinnest_wall : 0.0,
          mesh.contact && std::holds_alternative<FrameWalls>(spec.lattice)};
}

double contact_step_of(const ContactLaw& law, double mass) {
  const double ratio = std::numbers::sqrt2 * law.damping_ratio;
  return (std::sqrt(1.0 + ratio * ratio) - ratio) * std::sqrt(mass / law.stiffness);
}

double striker_step_of(const ContactLaw& law, double mass, double share) {
  if (share <= 2.0) {
    return contact_step_of(law, mass);
  }
  const double square = share * share / (share - 1.0);  // (omega / sqrt(k / m))^2
  const double damping = law.damping_ratio * std::sqrt(square);
  return 2.0 * (std::sqrt(1.0 + damping * damping) - damping) / std::sqrt(square * law.stiffness / mass);
}

}  // namespace cellcrush
