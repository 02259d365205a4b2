#include "scene/time_step.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace cellcrush {
namespace {

constexpr double kMmPerM = 1e3;
constexpr double kTravelPerStep = 0.05;  // of the thinnest wall, by the plate
constexpr double kTravelPerTau = 0.1;
/// Stiffest contact that a given step bears: 2 / sqrt 2 is the limit of two free particles, less that of their elements.
constexpr double kStiffestContactTurn = 0.6;
constexpr double kSkinFraction = 0.35;

/// Time in which the plate moves by the thinnest wall, s.
double wall_time(const SceneSpec& spec, const Scene& scene) {
  const auto thinner = [](const Element& a, const Element& b) { return a.thickness < b.thickness; };
  const double thinnest = std::min_element(scene.elements.begin(), scene.elements.end(), thinner)->thickness;
  return thinnest / (*spec.loading.speed_m_per_s * kMmPerM);
}

bool has_plates(const SceneSpec& spec) { return !std::holds_alternative<FrameLattice>(spec.lattice); }

}  // namespace

double time_step_of(const SceneSpec& spec, const Scene& scene) {
  if (spec.numerics.time_step_s > 0.0) {
    return spec.numerics.time_step_s;
  }
  const double step = kStepFraction * scene.stable_step;
  return has_plates(spec) ? std::min(step, kTravelPerStep * wall_time(spec, scene)) : step;
}

double penalty_stiffness(const SceneSpec& spec, const Scene& scene) {
  const double root = std::sqrt(spec.contact.stiffness_factor);
  double frequency = root / scene.stable_step;
  if (has_plates(spec)) {
    double of_impact = root / (kTravelPerTau * wall_time(spec, scene));
    if (spec.numerics.time_step_s > 0.0) {
      of_impact = std::min(of_impact, kStiffestContactTurn / spec.numerics.time_step_s);
    }
    frequency = std::max(frequency, of_impact);
  }
  const double lightest = *std::min_element(scene.mass.begin(), scene.mass.end());
  return lightest * frequency * frequency;
}

double contact_skin(const Scene& scene) {
  return kSkinFraction * *std::min_element(scene.undeformed_length.begin(), scene.undeformed_length.end());
}

}  // namespace cellcrush
