#include "scene/contact_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/tuning.h"
#include "scene/units.h"

namespace cellcrush {
namespace {

/// Penetration of a free particle at plate speed, as a fraction of the thickness of the thinnest wall (E9).
constexpr double kImpactDepth = 0.16;
/// Greatest phase angle omega dt of the lightest particle on its contact at a given step, rad; the 0.6 below E9.
constexpr double kMostPhase = 0.6;

/// Angular frequency sqrt(k / m_min) of the lightest particle on its contact, 1/s.
double contact_frequency(const SceneSpec& spec, const MeshMeasures& mesh) {
  const double of_mesh = std::sqrt(spec.contact.stiffness_factor) / mesh.steps.of_elements;
  if (std::holds_alternative<FrameLattice>(spec.lattice)) {
    return of_mesh;
  }
  const double of_impact = *spec.loading.speed_m_per_s * kMmPerM / (kImpactDepth * mesh.thinnest_wall);
  const double step = spec.numerics.time_step_s;
  return std::max(of_mesh, step > 0.0 ? std::min(of_impact, kMostPhase / step) : of_impact);
}

}  // namespace

ContactLaw contact_law_of(const SceneSpec& spec, const MeshMeasures& mesh) {
  const double frequency = contact_frequency(spec, mesh);
  return {mesh.contact,          mesh.lightest_mass * frequency * frequency, spec.contact.damping_ratio,
          spec.contact.friction, kSkinFraction * mesh.shortest_element,      kFaceSkinFraction * mesh.shortest_element,
          mesh.thinnest_wall};
}

double contact_step_of(const ContactLaw& law, double mass) {
  const double ratio = std::numbers::sqrt2 * law.damping_ratio;
  return (std::sqrt(1.0 + ratio * ratio) - ratio) * std::sqrt(mass / law.stiffness);
}

}  // namespace cellcrush
