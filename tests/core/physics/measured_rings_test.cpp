// Rings between two flat plates, with the hardening curve of the metal: one that was pressed in a testing machine, and
// a thick pipe that Abaqus computed with solids. Blind to: lattices, friction, and what a curve is beyond tension tests
// but for the power through its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::measured_rings {
namespace {

struct PressedRing {
  double radius;     // mm, mean
  double thickness;  // mm
  double depth;      // mm
  double modulus;    // MPa
  HardeningTable curve;
};

/// A force at an approach of the plates, N at mm.
struct Measured {
  double way;
  double force;
};

/// Computed over measured forces, of a ring of `elements` that is pressed to the last of them in `end` s.
std::vector<double> ratios(const PressedRing& ring, MaterialSpec::Plane plane, int elements, double end,
                           std::span<const Measured> measured) {
  const double way = 1.01 * measured.back().way;
  FrameLattice frame;
  for (int i = 0; i < elements; ++i) {
    const Vector2 place = ring.radius * scenes::direction(2.0 * std::numbers::pi * (i + 0.5) / elements);
    frame.nodes.push_back({place.x(), place.y(), 0.0, 0.0});
    frame.beams.push_back(scenes::beam(i, (i + 1) % elements, ring.thickness, 1));
  }
  const double top = ring.radius * std::cos(std::numbers::pi / elements) + 0.5 * ring.thickness;
  frame.rigid_walls = {{0.0, -top, 0.0, 1.0}, {0.0, top, 0.0, -1.0, 0.0, {{0.0, 0.0}, {end, way}}}};
  frame.end_time_s = end;
  SceneSpec spec = scenes::plastic_frame(std::move(frame), ring.modulus, ring.curve.stresses_mpa.front());
  spec.depth_mm = ring.depth;
  spec.material.hardening_table = ring.curve;
  spec.material.plane = plane;
  spec.material.poissons_ratio = 0.3;
  spec.numerics.mass_damping_per_s = 200.0;
  spec.output.sample_count = 400;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  std::vector<double> ratios;
  for (const Measured& point : measured) {
    double sum = 0.0;
    int count = 0;
    for (const Sample& sample : samples) {
      const RigidWallSample& plate = sample.rigid_walls.at(1);
      if (std::abs(plate.displacement - point.way) > std::max(0.004 * way, 0.02 * point.way)) continue;
      sum += plate.normal_force;
      ++count;
    }
    ratios.push_back(sum / count / point.force);
  }
  return ratios;
}

// compmod of the Universite Savoie: inner radius 45.96, outer 50.00, width 15.0 mm, E from the slope of the tension
// curve, which ends at a strain of .04.
const PressedRing kAluminiumRing = {
    47.98,
    4.04,
    15.0,
    64000.0,
    {{0.0, 1e-4, 2e-4, 4e-4, 7e-4, 1e-3, 1.5e-3, 2e-3, 3e-3, 5e-3, 8e-3, 0.012, 0.018, 0.025, 0.031, 0.036},
     {90.0, 93.2, 106.3, 120.4, 130.2, 135.4, 140.4, 143.6, 147.1, 150.7, 154.0, 158.0, 163.4, 168.9, 172.8, 175.3},
     HardeningTable::Beyond::power_law}};
constexpr Measured kMeasured[] = {{1, 300}, {5, 860}, {10, 923}, {20, 1000}, {30, 1084}, {40, 1183}, {44, 1230}};

// The ring is 3.7 times as wide as it is thick. Its hinges flow nearly as if they were held across, by up to 2 / sqrt 3
// of the yield stress; it bends elastically as if they were free.
TEST(MeasuredRing, FlowsAsInPlaneStrainAndBendsAsInPlaneStress) {
  const std::vector<double> held = ratios(kAluminiumRing, MaterialSpec::Plane::strain, 96, 0.2, kMeasured);
  const std::vector<double> free = ratios(kAluminiumRing, MaterialSpec::Plane::stress, 96, 0.2, kMeasured);
  double worst = 0.0;
  for (std::size_t i = 1; i < held.size(); ++i) {
    worst = std::max(worst, std::abs(held[i] - 1.0));
  }
  scenes::record_figure("plane strain at 1 mm", held.front(), 3);
  scenes::record_figure("plane stress at 1 mm", free.front(), 3, {1.0, 0.03});
  scenes::record_figure("plane strain at worst from 5 mm on in %", 100.0 * worst, 1, {0.0, 3.0});
  scenes::record_figure("plane stress at 30 mm", free[4], 3);
}

// Cardiff et al. 2017, read off a picture to 4 N/mm: radii 48.28, 57.15 mm. Half of the force at half of the approach.
TEST(MeasuredRing, OfAThickPipeBearsWhatSolidsDo) {
  const PressedRing pipe = {0.5 * (48.28 + 57.15),
                            57.15 - 48.28,
                            1.0,
                            186000.0,
                            {{0.0, 0.0035, 0.0083, 0.0133, 0.0182, 0.0281, 0.0380, 1.0},
                             {241.32, 275.79, 301.65, 318.88, 344.74, 361.98, 379.21, 1482.37},
                             HardeningTable::Beyond::last_slope}};
  std::vector<Measured> solids;
  for (const auto& [way, force] : {Measured{2, 274.9},
                                   {4, 301.0},
                                   {7, 320.6},
                                   {10.4, 339.2},
                                   {15.4, 373.3},
                                   {20.4, 418.3},
                                   {25.4, 481.8},
                                   {30.4, 571.0},
                                   {34, 683.2}}) {
    solids.push_back({2.0 * way, 2.0 * force});
  }
  double worst = 0.0;
  const std::vector<double> found = ratios(pipe, MaterialSpec::Plane::strain, 72, 0.1, solids);
  for (std::size_t i = 0; i < found.size(); ++i) {
    worst = std::max(worst, std::abs(found[i] - 1.0));
  }
  scenes::record_figure("pipe at worst in %", 100.0 * worst, 1, {0.0, 10.0});
}

}  // namespace
}  // namespace cellcrush::measured_rings
