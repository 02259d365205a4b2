// Loads as experiments have them, on walls at the edges of a lattice: strikers, pulses, a thrown lattice, loading and
// unloading, against the theory of a rigid, perfectly plastic, locking block and against elastic blocks. Blind to:
// frames, friction at the walls, and lattices other than hexagons along their rows.
#include "scenes/experiments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "push/crush.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush::experiments {
namespace {

using scenes::striker_at;
using scenes::wall_at;
using Edge = LoadsSpec::Edge;

/// Hexagons without plates, to be loaded for a time.
SceneSpec block(int columns, int rows, double end_time_s) {
  SceneSpec spec = scenes::spec_of({"hexagon", 1.0, 0.0}, columns, rows);
  spec.loading.speed_m_per_s.reset();
  spec.loading.end_strain.reset();
  spec.loading.end_time_s = end_time_s;
  return spec;
}

/// What the theory of a rigid, perfectly plastic, locking block needs of a lattice, from a crush at a constant speed.
struct LockingBlock {
  double strength = 0.0;  ///< sigma_0, MPa: at the support
  double locking = 0.0;   ///< eps_d, from the jump of the stress at the front
  double density = 0.0;   ///< rho_0, tonne / mm^3
  double area = 0.0;      ///< mm^2
  double length = 0.0;    ///< mm

  LockingBlock(int columns, int rows, double speed_m_per_s) {
    SceneSpec spec = scenes::spec_of({"hexagon", speed_m_per_s, 0.0}, columns, rows);
    spec.loading.end_strain = 0.45;
    const auto scene = scenes::build(spec);
    area = scene->width * scene->depth;
    length = scene->length;
    density = scene->total_mass / (area * length);
    const Summary summary = summarize(*scene, scenes::run_frame(spec));
    strength = *summary.plateau_stress_support;
    const double speed = kMmPerM * speed_m_per_s;
    locking = density * speed * speed / (*summary.plateau_stress_impact - strength);
  }

  [[nodiscard]] double mass() const { return density * area * length; }
  /// rho_0 V^2 / (sigma_0 eps_d)
  [[nodiscard]] double damage(double speed) const { return density * speed * speed / (strength * locking); }
};

constexpr int kColumns = 20;
constexpr int kRows = 8;
constexpr double kFast = 60.0;  // m/s

/// At half of the speed at which the experiments begin.
const LockingBlock& locking_block() {
  static const LockingBlock block(kColumns, kRows, 0.5 * kFast);
  return block;
}

// Tan et al. 2005: the stroke of a striker of mass m a unit area.
TEST(Experiment, AStrikerPenetratesAsIntoALockingBlock) {
  const LockingBlock& theory = locking_block();
  const double share = 0.6;  // of the block's mass
  const double speed = kMmPerM * kFast;
  SceneSpec spec = block(kColumns, kRows, 4e-3);
  spec.loading.end_at_rest = 1e-3;
  spec.loads.rigid_walls = {striker_at(Edge::left, share * 1e6 * theory.mass(), kFast), wall_at(Edge::right)};
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Summary summary = summarize(*scenes::build(spec), samples);
  const double crushed = share * theory.length * (std::sqrt(1.0 + theory.damage(speed)) - 1.0);
  const double stroke = summary.rigid_walls.at(0).stroke / (theory.locking * crushed);
  scenes::record_figure("stroke", stroke, 2, {1.0, 0.1});
  const double share_given = summary.rigid_walls[0].work / (0.5 * share * theory.mass() * speed * speed);
  scenes::record_figure("energy given off", share_given, 3, {1.0, 0.02});
}

// The rear end of a block that is thrown at a wall, and how much of it is crushed when it stands still.
TEST(Experiment, AThrownBlockStopsAsALockingOne) {
  const LockingBlock& theory = locking_block();
  SceneSpec spec = block(kColumns, kRows, 3e-3);
  spec.loads.velocity_x_m_per_s = kFast;
  spec.loads.rigid_walls = {wall_at(Edge::right)};
  const auto scene = scenes::build(spec);
  ASSERT_TRUE(scene->crushing_walls);
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const double speed = kMmPerM * kFast;
  const double crushed = 1.0 - std::exp(-0.5 * theory.damage(speed));
  const auto most = std::ranges::max_element(samples, {}, &Sample::strain);
  const double shortening = most->strain / (theory.locking * crushed);
  scenes::record_figure("shortening", shortening, 2, {1.0, 0.1});
}

// A rectangular pulse on a plate with mass.
TEST(Experiment, APulseDrivesAPlateAsIntoALockingBlock) {
  const LockingBlock& theory = locking_block();
  const double share = 0.3;
  const double pressure = 8.0 * theory.strength;
  const double duration = 3.5e-4;
  SceneSpec spec = block(kColumns, kRows, 4e-3);
  spec.loading.end_at_rest = 1e-3;
  LoadsSpec::RigidWall plate = wall_at(Edge::left);
  plate.own = {{"mass_g", share * 1e6 * theory.mass()}};
  plate.functions = {{"pressure_mpa", {{0.0, pressure}, {duration, pressure}, {duration + 1e-9, 0.0}}}};
  spec.loads.rigid_walls = {plate, wall_at(Edge::right)};
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Summary summary = summarize(*scenes::build(spec), samples);
  const double m = share * theory.density * theory.length;
  const double crushed = (std::sqrt(m * m + theory.density * pressure * (pressure - theory.strength) * duration *
                                                duration / (theory.strength * theory.locking)) -
                          m) /
                         theory.density;
  const double stroke = summary.rigid_walls.at(0).stroke / (theory.locking * crushed);
  scenes::record_figure("stroke", stroke, 2, {1.0, 0.1});
}

/// Slope of the support's stress over the strain, MPa, while the stress passes between two shares of a stress.
double slope_of(std::span<const Sample> samples, double stress) {
  const auto inside = [&](const Sample& sample) {
    return sample.stress_support > 0.2 * stress && sample.stress_support < 0.6 * stress;
  };
  const auto first = std::ranges::find_if(samples, inside);
  const auto end = std::find_if_not(first, samples.end(), inside);
  const Sample& last = *std::prev(end);
  return (last.stress_support - first->stress_support) / (last.strain - first->strain);
}

double greatest_stress(std::span<const Sample> samples) {
  return std::ranges::max(samples, {}, &Sample::stress_support).stress_support;
}

/// A block that is pressed slowly by `strain`, let go and pressed again, by the velocity of a wall. Even edges: all
/// corners touch at once.
SceneSpec pressed_and_released(double strain) {
  constexpr double kRamp = 2e-3;
  constexpr double kTime = 2e-2;
  SceneSpec spec = block(6, 6, 3.0 * kTime);
  spec.imperfection = {};
  const double speed = strain * scenes::build(spec)->length / (kTime - kRamp) / kMmPerM;
  LoadsSpec::RigidWall wall = wall_at(Edge::left);
  wall.functions = {{"velocity_m_per_s",
                     {{0.0, 0.0},
                      {kRamp, speed},
                      {kTime - kRamp, speed},
                      {kTime + kRamp, -speed},
                      {2.0 * kTime - kRamp, -speed},
                      {2.0 * kTime + kRamp, speed}}}};
  spec.loads.rigid_walls = {wall, wall_at(Edge::right)};
  spec.numerics.mass_damping_per_s = 1e4;
  return spec;
}

// Beyond its collapse, the lattice unloads and loads as an elastic one of its new shape. That is flatter by 1 %: walls
// have turned by 0.016 rad, and E* has fallen by 7 %, to first order in the angle.
TEST(Experiment, UnloadingIsElastic) {
  const std::vector<Sample> samples = scenes::run_frame(pressed_and_released(0.012));
  const std::span<const Sample> all = samples;
  const double most = greatest_stress(samples);
  const std::size_t third = samples.size() / 3;
  const double loading = slope_of(all.first(third), most);
  const double unloading = slope_of(all.subspan(third, third), most);
  const double reloading = slope_of(all.subspan(2 * third), most);
  scenes::record_figure("unloading over loading", unloading / loading, 2, {1.0, 0.08});
  scenes::record_figure("loading again over unloading", reloading / unloading, 3, {1.0, 0.01});
}

// A mass on a spring: E* A / L. A third of the spring's mass swings with it.
TEST(Experiment, AnElasticBlockThrowsAStrikerBack) {
  SceneSpec slow = pressed_and_released(0.0005);
  slow.material.yield_stress_mpa = 1e9;
  const auto scene = scenes::build(slow);
  const std::vector<Sample> pressed = scenes::run_frame(slow);
  const double stiffness = slope_of(pressed, greatest_stress(pressed)) * scene->width * scene->depth / scene->length;

  constexpr double kShare = 30.0;  // of the block's mass
  const double mass = kShare * scene->total_mass;
  const double period = 2.0 * std::numbers::pi * std::sqrt(mass * (1.0 + 1.0 / (3.0 * kShare)) / stiffness);
  const double speed = 2.0 * std::numbers::pi / period * 0.0005 * scene->length;
  SceneSpec spec = block(6, 6, 0.6 * period);
  spec.imperfection = {};
  spec.material.yield_stress_mpa = 1e9;
  spec.loads.rigid_walls = {striker_at(Edge::left, 1e6 * mass, speed / kMmPerM), wall_at(Edge::right)};
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const auto left = std::ranges::find_if(samples, [](const Sample& sample) {
    return sample.rigid_walls[0].speed < 0.0 && sample.rigid_walls[0].displacement < 0.0;
  });
  ASSERT_NE(left, samples.end());
  scenes::record_figure("rebound", -left->rigid_walls[0].speed / speed, 2, {1.0, 0.02});
  scenes::record_figure("time of contact", left->time / (0.5 * period), 2, {1.0, 0.02});
}

// What a force gives to plate and lattice together, which nothing else holds.
TEST(Experiment, AForceGivesItsImpulse) {
  SceneSpec spec = block(6, 4, 1e-3);
  LoadsSpec::RigidWall plate = wall_at(Edge::bottom);
  plate.own = {{"mass_g", 2.0}};
  plate.functions = {{"force_n", {{0.0, 0.0}, {2e-4, 300.0}, {5e-4, 0.0}}}};
  spec.loads.rigid_walls = {plate};
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const double step = scene->schedule.time_step;
  // Velocities are half a step old: the force of the start counts for half of a step.
  double impulse = -0.5 * step * scene->rigid_walls[0].force.value_at(0.0);
  scenes::follow(simulation, [&](const State& state) {
    impulse += step * scene->rigid_walls[0].force.value_at(state.time - step);
  });
  const State& state = simulation.state();
  const double momentum =
      scenes::momentum_of(*scene, state).linear.y() + scene->rigid_walls[0].mass * state.rigid_wall_motion.at(0).speed;
  EXPECT_NEAR(impulse, 0.075, 1e-5);
  scenes::record_bound("momentum error", std::abs(momentum / impulse - 1.0), 1e-9);
  EXPECT_GT(crush_travel_of(*scene, state), 0.0);  // the lattice alone is shorter
}

// A velocity is integrated as that of a particle.
TEST(Experiment, AVelocityTakesAWallWhereItsIntegralIs) {
  SceneSpec spec = pressed_and_released(0.004);
  const auto scene = scenes::build(spec);
  double worst = 0.0;
  double most = 0.0;
  for (const Sample& sample : scenes::run_frame(spec)) {
    const double exact = scene->rigid_walls[0].motion.value_at(sample.time);
    // The integral is exact at its points and where the velocity is constant.
    const bool is_even = sample.time > 2e-3 && sample.time < 1.8e-2;
    if (is_even) worst = std::max(worst, std::abs(sample.rigid_walls[0].displacement - exact));
    most = std::max(most, exact);
  }
  scenes::record_bound("way error", worst / most, 1e-6);
}

TEST(Experiment, ADropHeightIsTheSpeedOfTheFall) {
  SceneSpec spec = block(3, 3, 1e-4);
  LoadsSpec::RigidWall weight = wall_at(Edge::top);
  weight.own = {{"mass_g", 10.0}, {"drop_height_mm", 500.0}};
  spec.loads.rigid_walls = {weight, wall_at(Edge::bottom)};
  EXPECT_EQ(build_scene(spec).problems.at(0).field, "loading.rigid_walls[0].drop_height_mm");  // without gravity
  spec.loads.gravity_y_m_per_s2 = -9.81;
  EXPECT_NEAR(scenes::build(spec)->rigid_walls[0].speed, std::sqrt(2.0 * 9810.0 * 500.0), 1e-6);
}

TEST(Experiment, APressureActsOnTheWidthOfTheLatticeAtItsEdge) {
  for (const Edge edge : {Edge::left, Edge::top}) {
    SceneSpec spec = block(6, 3, 1e-4);
    LoadsSpec::RigidWall plate = wall_at(edge);
    plate.own = {{"mass_g", 10.0}};
    plate.functions = {{"pressure_mpa", {{0.0, 2.0}}}};
    spec.loads.rigid_walls = {plate};
    const auto scene = scenes::build(spec);
    // The envelope before imperfections counts.
    EXPECT_NEAR(scene->rigid_walls[0].force.value_at(0.0) / (2.0 * scene->width * scene->depth), 1.0, 2e-3);
  }
}

TEST(Experiment, AWallAtAnEdgeTouchesTheLattice) {
  SceneSpec spec = block(4, 3, 1e-4);
  for (const Edge edge : {Edge::left, Edge::right, Edge::bottom, Edge::top})
    spec.loads.rigid_walls.push_back(wall_at(edge));
  const auto scene = scenes::build(spec);
  for (const RigidWall& wall : scene->rigid_walls) {
    double gap = 1e9;
    for (std::size_t i = 0; i < scene->particle_count(); ++i) {
      gap = std::min(gap, wall.normal.dot(scene->position[i] - wall.point) - scene->radius[i]);
    }
    EXPECT_NEAR(gap, 0.0, 1e-12);
  }
}

std::string field_of(const LoadsSpec::RigidWall& wall) {
  SceneSpec spec = block(3, 3, 1e-4);
  spec.loads.rigid_walls = {wall};
  const Problems problems = build_scene(spec).problems;
  return problems.empty() ? "" : problems[0].field.substr(std::string("loading.rigid_walls[0].").size());
}

TEST(Experiment, WallsAreRefusedByTheFieldsThatDoNotGoTogether) {
  const LoadsSpec::TimeFunction even = {{0.0, 1.0}};
  LoadsSpec::RigidWall wall = wall_at(Edge::left);
  EXPECT_EQ(field_of(wall), "");
  wall.normal_x = 1.0;
  EXPECT_EQ(field_of(wall), "edge");
  wall = wall_at(Edge::left);
  wall.functions = {{"force_n", even}};
  EXPECT_EQ(field_of(wall), "force_n");  // no mass
  wall.own = {{"mass_g", 1.0}};
  EXPECT_EQ(field_of(wall), "");
  wall.functions["pressure_mpa"] = even;
  EXPECT_EQ(field_of(wall), "pressure_mpa");
  wall.functions = {{"velocity_m_per_s", even}};
  EXPECT_EQ(field_of(wall), "velocity_m_per_s");
  wall.own.clear();
  EXPECT_EQ(field_of(wall), "");
  wall.functions = {{"velocity_m_per_s", {{0.0, 1001.0}}}};
  EXPECT_EQ(field_of(wall), "velocity_m_per_s");
  wall.functions = {{"velocity_m_per_s", {{1.0, 1.0}, {0.0, 1.0}}}};
  EXPECT_EQ(field_of(wall), "velocity_m_per_s.points");
  wall.functions = {{"velocity_m_per_s", even}};
  wall.points = even;
  EXPECT_EQ(field_of(wall), "velocity_m_per_s");
  LoadsSpec::RigidWall apart = {0.0, -9.0, 0.0, 1.0};
  apart.own = {{"mass_g", 1.0}};
  apart.functions = {{"pressure_mpa", even}};
  EXPECT_EQ(field_of(apart), "pressure_mpa");
}

TEST(Experiment, EndsAtAStrainIfOneIsGiven) {
  SceneSpec spec = scenes::struck_block();
  spec.loading.end_strain = 0.3;
  const auto scene = scenes::build(spec);
  const std::vector<Sample> samples = scenes::run_frame(spec);
  EXPECT_GE(samples.back().strain, 0.3);
  EXPECT_LT(samples.back().strain, 0.31);
  EXPECT_EQ(summarize(*scene, samples).end, RunEnd::strain);
  spec.loads.rigid_walls = {wall_at(Edge::left), wall_at(Edge::right)};  // which stand still
  EXPECT_EQ(build_scene(spec).problems.at(0).field, "loading.end_strain");
}

TEST(Experiment, HasRealMasses) {
  SceneSpec struck = scenes::struck_block();
  struck.numerics.mass_scaling = 2.0;
  EXPECT_EQ(build_scene(struck).problems.at(0).field, "numerics.mass_scaling");
  SceneSpec thrown = scenes::thrown_block();
  thrown.numerics.mass_scaling = 2.0;
  EXPECT_EQ(build_scene(thrown).problems.at(0).field, "numerics.mass_scaling");
  SceneSpec heavy = scenes::hexagon_specimen(4, 3);
  heavy.numerics.mass_scaling = 2.0;
  EXPECT_TRUE(build_scene(heavy).problems.empty());
  heavy.loads.gravity_y_m_per_s2 = -9.81;
  EXPECT_EQ(build_scene(heavy).problems.at(0).field, "numerics.mass_scaling");
}

}  // namespace
}  // namespace cellcrush::experiments
