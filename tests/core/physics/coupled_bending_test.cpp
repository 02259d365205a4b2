// Walls whose bending is coupled with stretching (E5j): the length of a bent bar and a closed loop of motions, elastic,
// by the energy of both; quarter and half rings against solids that share no code with the solver. Blind to: walls that
// shorten beside bending, and unloading to the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "core/reference/plane_solid.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::coupled_bending {
namespace {

using Component = FrameLattice::Component;
using TimeFunction = FrameLattice::TimeFunction;

constexpr double kLength = 10.0;  // mm
constexpr double kModulus = 70000.0;

SceneSpec coupled(SceneSpec spec) {
  spec.section.coupled_bending = true;
  return spec;
}

/// Elastic, and damped as the first mode of a cantilever of kLength needs.
SceneSpec slow(FrameLattice frame, double thickness, double seconds) {
  frame.end_time_s = seconds;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  spec.numerics.mass_damping_per_s =
      3.516 * std::sqrt(kModulus / (scenes::kDensity * 1e-12) / 12.0) * thickness / (kLength * kLength);
  return spec;
}

// The energy of even stretch and curvature is least where N = 0: EA e = M kappa.
TEST(CoupledBending, AMomentLengthensABarByItsCurvature) {
  constexpr double kThickness = 1.0;
  constexpr double kRadius = 10.0;
  FrameLattice frame = scenes::bar(kLength, kThickness, 16);
  frame.supports = {{0, true, true, true}};
  const double moment = kModulus * std::pow(kThickness, 3) / 12.0 / kRadius;
  frame.loads = {{1, Component::rotation, {{0.0, 0.0}, {0.004, moment}}}};
  const SceneSpec spec = slow(frame, kThickness, 0.008);
  const auto growth_of = [](const SceneSpec& of) {
    Simulation simulation(scenes::build(of));
    scenes::run_to_end(simulation);
    const auto& lengths = simulation.state().length;
    return std::accumulate(lengths.begin(), lengths.end(), 0.0) / kLength - 1.0;
  };
  const double exact = std::pow(kThickness / kRadius, 2) / 12.0;
  scenes::record_figure("growth over h^2 / 12 R^2", growth_of(coupled(spec)) / exact, 3, {1.0, 0.01});
  EXPECT_LT(std::abs(growth_of(spec)), 1e-3 * exact);
}

// Stretched, bent, released and turned back, elements shorter than they are thick bear nothing: one, an odd number, and
// pairs, in either formulation.
TEST(CoupledBending, AClosedLoopOfElasticMotionsLeavesNoEnergy) {
  constexpr double kThickness = 2.0;
  constexpr double kSeconds = 0.02;
  const auto through = [&](double first, double second, double third) {
    return TimeFunction{{0.0, 0.0},
                        {0.2 * kSeconds, first},
                        {0.4 * kSeconds, second},
                        {0.6 * kSeconds, third},
                        {0.8 * kSeconds, 0.0},
                        {kSeconds, 0.0}};
  };
  double left = 0.0;
  double residual = 0.0;
  using Formulation = SectionSpec::Formulation;
  for (const auto& [elements, formulation] : {std::pair(8, Formulation::force_based),
                                              {5, Formulation::force_based},
                                              {1, Formulation::force_based},
                                              {5, Formulation::displacement_based}}) {
    FrameLattice frame = scenes::bar(kLength, kThickness, elements);
    frame.supports = {{0, true, true, true}};
    frame.motions = {{1, Component::x, through(0.5, 0.5, 0.0)},
                     {1, Component::y, through(0.0, 1.0, 1.0)},
                     {1, Component::rotation, through(0.0, 0.3, 0.3)}};
    SceneSpec spec = coupled(slow(frame, kThickness, kSeconds));
    spec.section.formulation = formulation;
    Simulation simulation(scenes::build(spec));
    double greatest = 0.0;
    Energies last;
    scenes::watch(simulation, [&](const Sample& sample) {
      last = sample.energies;
      greatest = std::max(greatest, last.elastic);
    });
    left = std::max(left, last.elastic / greatest);
    residual = std::max(residual, std::abs(last.residual) / greatest);
  }
  scenes::record_bound("energy left in %", 100.0 * left, 1e-3);
  scenes::record_bound("residual in %", 100.0 * residual, 1e-2);
}

// A half ring of n elements has turns of 90 / n degrees at either end of each.
TEST(CoupledBending, WallsDrawnAsArcsAreTurnedAtTheStart) {
  for (const int elements : {5, 8}) {
    NetworkWalls walls;
    walls.joints_mm = {0.0, 0.0, 20.0, 0.0};
    walls.walls = {0, 1};
    walls.rises_mm = {10.0};
    walls.wall_thickness_mm = 2.0;
    SceneSpec spec = coupled(scenes::plastic_frame({}, kModulus, 100.0, scenes::kDensity));
    spec.lattice = walls;
    spec.elements_per_wall = elements;
    LoadsSpec::Grip bottom;
    bottom.edge = LoadsSpec::Edge::bottom;
    spec.loads.grips = {bottom};
    spec.loading.end_time_s = 1e-4;
    const Simulation simulation(scenes::build(spec));
    for (int e = 0; e < elements; ++e) {
      EXPECT_NEAR(simulation.state().start_turn[e], 0.5 * std::numbers::pi / elements, 1e-9);
      EXPECT_NEAR(simulation.state().end_turn[e], -0.5 * std::numbers::pi / elements, 1e-9);
    }
  }
}

constexpr reference::SolidMetal kMetal = {689.56, 0.32, 31.0, 261.2};
constexpr double kThickness = 2.0;

/// The same arcs as beams that shear, their ends in grips: those of the first stand at the bottom, the others move at
/// the top.
SceneSpec as_beams(const std::vector<reference::SolidArc>& arcs, double friction, double seconds) {
  NetworkWalls walls;
  walls.wall_thickness_mm = kThickness;
  LoadsSpec::Grip top;
  top.edge = LoadsSpec::Edge::top;
  for (const reference::SolidArc& arc : arcs) {
    const double radius = 0.5 * (arc.inner + arc.outer);
    const int first = static_cast<int>(walls.joint_count());
    for (const reference::SolidEnd& end : {arc.last, arc.first}) {
      const double angle = std::numbers::pi / 180.0 * end.angle;
      walls.joints_mm.push_back(arc.centre_x + std::round(std::cos(angle)) * radius);
      walls.joints_mm.push_back(arc.centre_y + std::round(std::sin(angle)) * radius);
      if (end.motion_x != 0.0) top.x_points = {{0.0, 0.0}, {seconds, end.motion_x}};
      if (end.motion_y != 0.0) top.y_points = {{0.0, 0.0}, {seconds, end.motion_y}};
    }
    walls.walls.insert(walls.walls.end(), {first, first + 1});
    const double half = 0.5 * std::numbers::pi / 180.0 * (arc.last.angle - arc.first.angle);
    walls.rises_mm.push_back(radius * (1.0 - std::cos(half)));
  }
  SceneSpec spec;
  spec.lattice = walls;
  spec.depth_mm = 1.0;
  spec.elements_per_wall = 32;
  spec.material.youngs_modulus_mpa = kMetal.youngs_modulus;
  spec.material.yield_stress_mpa = kMetal.yield_stress;
  spec.material.hardening_modulus_mpa = kMetal.hardening_modulus;
  spec.material.density_kg_per_m3 = 1000.0;
  spec.material.plane = MaterialSpec::Plane::strain;
  spec.material.poissons_ratio = kMetal.poissons_ratio;
  spec.section.shear_deformation = true;
  spec.contact.friction = friction;
  LoadsSpec::Grip bottom;
  bottom.edge = LoadsSpec::Edge::bottom;
  spec.loads.grips = {bottom, top};
  spec.loading.end_time_s = seconds;
  spec.output.sample_count = 2000;
  return spec;
}

using Forces = std::vector<reference::SolidForce>;

/// On the lower grip.
Forces forces_of(const SceneSpec& spec) {
  Forces forces;
  Simulation simulation(scenes::build(spec));
  scenes::watch(simulation, [&](const Sample& sample) {
    forces.push_back({sample.time, sample.grips.front().force_x, sample.grips.front().force_y});
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  for (reference::SolidForce& force : forces) force.share /= simulation.time();
  return forces;
}

/// Over a hundredth of the motion: contacts of beams go from node to node.
reference::SolidForce mean_at(const Forces& forces, double share) {
  reference::SolidForce mean;
  double count = 0.0;
  for (const reference::SolidForce& force : forces) {
    if (std::abs(force.share - share) > 0.005) continue;
    mean.x += force.x;
    mean.y += force.y;
    ++count;
  }
  EXPECT_TRUE(count > 0.0 && std::isfinite(mean.x) && std::isfinite(mean.y)) << share;
  return {share, mean.x / count, mean.y / count};
}

/// The greatest difference of the forces along x and y at each twentieth of the motion, over the greatest of solids, %.
double difference(const Forces& beams, const Forces& solids) {
  double greatest = 0.0;
  double worst = 0.0;
  for (int i = 1; i < 20; ++i) {
    const reference::SolidForce solid = mean_at(solids, 0.05 * i);
    const reference::SolidForce beam = mean_at(beams, 0.05 * i);
    greatest = std::max(greatest, std::hypot(solid.x, solid.y));
    worst = std::max({worst, std::abs(beam.x - solid.x), std::abs(beam.y - solid.y)});
  }
  return 100.0 * worst / greatest;
}

double difference(const SceneSpec& beams, const Forces& solids) { return difference(forces_of(beams), solids); }

TEST(CoupledBending, AQuarterRingBearsWhatASolidOneDoes) {
  const std::vector<reference::SolidArc> arcs = {{0.0, 0.0, 10.0, 12.0, {90.0, 0.0, -6.0}, {180.0, 0.0, 0.0}}};
  const reference::SolidRun run = {.across = 4, .speed = 2e-3};
  const auto solids = reference::move_arcs(arcs, kMetal, run);
  const SceneSpec beams = as_beams(arcs, 0.0, 0.05);
  const double with = difference(coupled(beams), solids);
  const double without = difference(beams, solids);
  EXPECT_LT(with, 0.9 * without);
  scenes::record_bound("difference from solids in %", with, 4.0);
  scenes::record_bound("uncoupled in %", without);
}

TEST(CoupledBending, SlidingHalfRingsBearWhatSolidOnesDo) {
  const std::vector<reference::SolidArc> arcs = {{12.0, 0.0, 10.0, 12.0, {0.0, 0.0, 0.0}, {180.0, 0.0, 0.0}},
                                                 {-1.964, 17.0, 8.0, 10.0, {180.0, 31.5, 0.0}, {360.0, 31.5, 0.0}}};
  for (const double friction : {0.0, 0.3}) {
    const std::string words = friction == 0.0 ? " without friction" : " with friction";
    const reference::SolidRun run = {.across = 4, .speed = 5e-4, .friction = friction};
    const auto solids = reference::move_arcs(arcs, kMetal, run);
    const SceneSpec beams = as_beams(arcs, friction, 0.2);
    const double with = difference(coupled(beams), solids);
    const double without = difference(beams, solids);
    EXPECT_LT(with, 0.7 * without);
    scenes::record_bound("difference from solids in %" + words, with, 10.0);
    scenes::record_bound("uncoupled in %" + words, without);
  }
}

// What four elements across leave out, of the greatest force.
TEST(CoupledBending, SolidsOfFourElementsAcrossBearWhatThoseOfEightDo) {
  const std::vector<reference::SolidArc> arcs = {{0.0, 0.0, 10.0, 12.0, {90.0, 0.0, -6.0}, {180.0, 0.0, 0.0}}};
  const auto four = reference::move_arcs(arcs, kMetal, {.across = 4, .speed = 2e-3});
  const auto eight = reference::move_arcs(arcs, kMetal, {.across = 8, .speed = 2e-3});
  scenes::record_bound("difference in %", difference(four, eight), 2.0);
}

}  // namespace
}  // namespace cellcrush::coupled_bending
