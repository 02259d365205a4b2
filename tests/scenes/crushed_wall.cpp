#include "scenes/crushed_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

const double kLever = CrushedWall::kLength * std::numbers::sqrt3 / 2.0;
constexpr double kHeight = 1.5 * CrushedWall::kLength;  // of the lattice, for one wall

/// First natural frequency of the wall, clamped below and guided above, 1/s.
double first_frequency() {
  const double wave_speed = std::sqrt(CrushedWall::kModulus / (kDensity * 1e-12));
  return 5.593 * wave_speed * CrushedWall::kThickness / std::sqrt(12.0) / (CrushedWall::kLength * CrushedWall::kLength);
}

/// External work up to a strain, between samples straight.
double work_at(const std::vector<Sample>& samples, double strain) {
  const auto strain_of = [](const Sample& sample) { return -sample.watched.front().uy / kHeight; };
  const auto after = std::lower_bound(samples.begin() + 1, samples.end() - 1, strain,
                                      [&](const Sample& sample, double at) { return strain_of(sample) < at; });
  const auto before = after - 1;
  const double share = (strain - strain_of(*before)) / (strain_of(*after) - strain_of(*before));
  return before->work_external + share * (after->work_external - before->work_external);
}

}  // namespace

SceneSpec CrushedWall::spec(int elements, const SectionSpec& section) {
  const double end = 120.0 * 2.0 * std::numbers::pi / first_frequency();
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLever, 0.5 * kLength, 0.0, 0.0}};
  frame.beams = {beam(0, 1, kThickness, elements)};
  frame.supports = {{0, true, true, true}, {1, false, false, true}};
  frame.motions = {{1, FrameLattice::Component::y, {{0.0, 0.0}, {end, -kEndStrain * kHeight}}}};
  frame.watched_nodes = {1};
  frame.end_time_s = end;
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = kModulus;
  spec.material.yield_stress_mpa = kYieldStress;
  spec.material.hardening_modulus_mpa = kModulus * kTangent / (kModulus - kTangent);
  spec.material.density_kg_per_m3 = kDensity;
  spec.section = section;
  spec.numerics.mass_damping_per_s = 0.1 * first_frequency();
  spec.output.sample_count = 2000;
  return spec;
}

double CrushedWall::stress_at(const std::vector<Sample>& samples, double strain) {
  constexpr double kHalfWindow = 0.001;
  const double force =
      (work_at(samples, strain + kHalfWindow) - work_at(samples, strain - kHalfWindow)) / (2.0 * kHalfWindow * kHeight);
  return force / kLever;
}

}  // namespace cellcrush::scenes
