// A mass strikes the middle of a perfectly plastic beam that is clamped at both ends. One end may slide along the beam,
// so that it only bends (Parkes 1958), or both are held, so that it is stretched too (Jones 1989). Blind to: rate
// dependence, and blows beside the middle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "cellcrush/sample.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush::struck_beam {
namespace {

constexpr double kHalf = 100.0;  // mm, half of the span
constexpr double kThickness = 4.0;
constexpr double kModulus = 200000.0;
constexpr double kYieldStress = 10.0;
constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;
constexpr double kMassPerLength = 7.85e-9 * kThickness;
constexpr double kBeamMass = 2.0 * kMassPerLength * kHalf;

/// The beam, whose middle node bears a mass of `ratio` times its own and starts at `speed` mm/s.
SceneSpec struck(double ratio, double speed, bool held, double end_time) {
  FrameLattice frame;
  constexpr int kElements = 16;  // of either half
  const double own = kMassPerLength * kHalf / kElements;
  frame.nodes = {
      {0.0, 0.0, 0.0, 0.0}, {kHalf, 0.0, (ratio * kBeamMass - own) * 1e6, 0.0}, {2.0 * kHalf, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, kElements), scenes::beam(1, 2, kThickness, kElements)};
  frame.supports = {{0, true, true, true}, {2, held, true, true}};
  frame.initial_velocities = {{1, 0.0, 1e-3 * speed, 0.0}};
  frame.watched_nodes = {1};
  frame.end_time_s = end_time;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.material.youngs_modulus_mpa = kModulus;
  spec.material.yield_stress_mpa = kYieldStress;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.output.sample_count = 1000;
  return spec;
}

/// Where the middle comes to rest: the time of its first maximum, and the mean deflection of the elastic vibration
/// after it, weighted by 1 - cos.
struct Rest {
  double time = 0.0;
  double deflection = 0.0;
  double plastic_work = 0.0;  // N mm
};

Rest rest_of(const std::vector<Sample>& samples) {
  std::size_t peak = 1;
  while (peak + 1 < samples.size() && samples[peak + 1].watched[0].uy > samples[peak].watched[0].uy) ++peak;
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = peak; i < samples.size(); ++i) {
    const double share = (static_cast<double>(i - peak) + 0.5) / static_cast<double>(samples.size() - peak);
    const double weight = 1.0 - std::cos(2.0 * std::numbers::pi * share);
    sum += weight * samples[i].watched[0].uy;
    weights += weight;
  }
  return {samples[peak].time, sum / weights, samples.back().energies.plastic};
}

// Half of the beam is the struck cantilever of Parkes (1955) with half of the mass. It has M_p at both of its hinges,
// so 2 M_p stands where the cantilever has M_p (Parkes 1958). With M half of the striking mass, l half of the span and
// b = rho l / 2 M: w = M^2 V^2 / (6 rho M_p) (b / (1 + b) + 2 ln(1 + b)), at the time M V l / 2 M_p.
TEST(StruckBeam, WithSlidingEndsComesToRestWhereAndWhenParkesHasIt) {
  constexpr double kDeflection = 4.0;  // mm: the energy is 45 times what the beam can bear elastically
  for (const double ratio : {5.0, 20.0}) {
    const double mass = 0.5 * ratio * kBeamMass;
    const double light = kMassPerLength * kHalf / (2.0 * mass);
    const double shape = light / (1.0 + light) + 2.0 * std::log(1.0 + light);
    const double speed = std::sqrt(kDeflection * 6.0 * kMassPerLength * kFullMoment / shape) / mass;
    const double time = mass * speed * kHalf / (2.0 * kFullMoment);
    const Rest rest = rest_of(scenes::run_frame(struck(ratio, speed, false, 3.0 * time)));
    EXPECT_NEAR(rest.deflection / kDeflection, 1.0, 0.02) << ratio;
    EXPECT_NEAR(rest.time / time, 1.0, 0.025) << ratio;
    EXPECT_NEAR(rest.plastic_work / (mass * speed * speed), 1.0, 0.01) << ratio;
    const std::string name = ratio == 5.0 ? "mass of five beams: " : "mass of twenty beams: ";
    scenes::record_figure(name + "deflection", rest.deflection / kDeflection, 4);
    scenes::record_figure(name + "time", rest.time / time, 3);
  }
}

// Membrane forces: a beam that is held along its axis bears P = 4 M_p / l (1 + (w / h)^2) at its middle up to w = h,
// then 8 M_p w / l h (AxialForceWithMoment.Held). A mass much heavier than the beam comes to rest where its energy has
// done the work of that (Jones 1989).
TEST(StruckBeam, HeldAlongItsAxisComesToRestWhereMembraneForcesStopIt) {
  for (const double share : {1.0, 2.0}) {  // deflection over thickness
    const double ratio = 20.0;
    const double over_load = share <= 1.0 ? share + share * share * share / 3.0 : 4.0 / 3.0 + share * share - 1.0;
    const double work = 4.0 * kFullMoment / kHalf * kThickness * over_load;
    const double speed = std::sqrt(2.0 * work / (ratio * kBeamMass));
    const double time = ratio * kBeamMass * speed * kHalf / (4.0 * kFullMoment);  // of a beam that only bends
    const Rest rest = rest_of(scenes::run_frame(struck(ratio, speed, true, 2.0 * time)));
    const double deflection = rest.deflection / (share * kThickness);
    EXPECT_NEAR(deflection, 1.0, 0.02) << share;
    EXPECT_NEAR(rest.plastic_work / work, 1.0, 0.01) << share;
    scenes::record_figure(share == 1.0 ? "a thickness" : "two thicknesses", deflection, 4);
  }
}

}  // namespace
}  // namespace cellcrush::struck_beam
