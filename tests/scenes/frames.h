#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// A frame with what acts on it and its end, in one list. Only put_frame gives it to a spec: both bases are private, so
/// that no assignment can lose the rest.
struct FrameLattice : private FrameWalls, private LoadsSpec {
  using FrameWalls::Node, FrameWalls::Beam, FrameWalls::Support;
  using FrameWalls::nodes, FrameWalls::beams, FrameWalls::supports, FrameWalls::self_contact, FrameWalls::watched_nodes;
  using LoadsSpec::Component, LoadsSpec::DistributedLoad, LoadsSpec::TimeFunction;
  using LoadsSpec::gravity_x_m_per_s2, LoadsSpec::gravity_y_m_per_s2, LoadsSpec::rigid_walls;
  using LoadsSpec::loads, LoadsSpec::motions, LoadsSpec::distributed_loads, LoadsSpec::initial_velocities;

  std::optional<double> end_time_s = std::nullopt;

  [[nodiscard]] const FrameWalls& walls() const { return *this; }
  [[nodiscard]] const LoadsSpec& acting() const { return *this; }
};

}  // namespace cellcrush
namespace cellcrush::scenes {

inline constexpr double kDensity = 2700.0;  ///< kg/m^3, of aluminium

/// The unit vector at an angle from the x axis, rad.
inline Vector2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Gives a spec the walls, loads and end of a frame.
void put_frame(const FrameLattice& frame, SceneSpec& spec);

/// A beam of a frame, of the case's material.
FrameLattice::Beam beam(int start, int end, double thickness_mm, int elements);

/// A beam along x from the origin; its nodes are 0 and 1.
FrameLattice bar(double length_mm, double thickness_mm, int elements);

/// Beams of one thickness between nodes, which may touch each other.
FrameLattice touching_beams(const std::vector<Vector2>& nodes, const std::vector<std::pair<int, int>>& beams,
                            double thickness_mm, int elements);

/// A case of an explicit frame, 1 mm deep, that ends after a second unless the frame says when: of elastic aluminium,
/// or of a perfectly plastic metal (MPa), steel unless the density (kg/m^3) is another.
SceneSpec elastic_frame(FrameLattice frame);
SceneSpec plastic_frame(FrameLattice frame, double modulus, double yield_stress, double density = 7850.0);

SceneSpec in_double_precision(SceneSpec spec);
SceneSpec in_single_precision(SceneSpec spec);

/// A cantilever along x, clamped at its left end, elastic, without contact: EI = 200000/12 N mm^2, L = 300 mm, h = 1
/// mm, so that EA L^2 / EI = 1.08e6. Its free end is node 1. Mass damping is twice the first natural frequency.
struct Cantilever {
  static constexpr double kLength = 300.0;
  static constexpr double kStiffness = 200000.0 / 12.0;
  static double first_frequency();

  /// Load on the free end rises linearly to `value` over `rise_time` and stays.
  static SceneSpec spec(int elements, FrameLattice::Component component, double value, double rise_time,
                        double end_time);
};

/// A short beam that lies flat over a long one that is held at both ends, 0.01 mm beyond touch: each of its two balls
/// meets the wall like a mass on a spring, and no beam bends. All beams are 1 mm thick, elastic, one element long;
/// contact is without damping. The short beam has the nodes 2 and 3; it flies down at `speed_m_per_s` under
/// `gravity_m_per_s2`.
SceneSpec beam_over_beam(double speed_m_per_s, double gravity_m_per_s2);

/// A specimen of the hexagons of Type I, crushed along x at 100 m/s.
SceneSpec hexagon_specimen(int columns, int rows);

/// A scene whose spec has no problems; fails the test with their texts when it has.
std::shared_ptr<Scene> build(const SceneSpec& spec);

/// The joints and walls of a regular lattice as nodes and beams of a frame, between the plates of the spec if it has
/// them.
SceneSpec listed(SceneSpec spec);

/// The same walls as a network, before any imperfection. REQUIRES: a checked spec of a regular lattice without
/// inclusions, or of a frame of one material without pins.
SceneSpec as_network(const SceneSpec& spec);

/// Small velocities in all directions for every particle, the same ones each time: what no symmetry hides from.
void stir(Scene& scene, double speed);

/// Runs a simulation to its end, or to what ends it, and calls visit(sample) after every `interval` steps; 0: as often
/// as the case samples.
template <class Visit>
void watch(Simulation& simulation, const Visit& visit, std::int64_t interval = 0) {
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(interval > 0 ? interval : simulation.scene().schedule.sample_interval);
    visit(simulation.take_sample());
  }
}

/// Calls visit(state) after every step of a run, without samples.
template <class Visit>
void follow(Simulation& simulation, const Visit& visit) {
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    visit(simulation.state());
  }
}

/// The samples of a run; fails the test with the cause when it does not come to its end.
std::vector<Sample> run_to_end(Simulation& simulation);
std::vector<Sample> run_frame(const SceneSpec& spec);

/// The state of a scene after steps from its start.
State state_after(const Scene& scene, int steps);

/// Along x and y, and about the origin. Positions and velocities half a step apart keep it to round-off where forces
/// balance.
struct Momentum {
  Vector2 linear = Vector2::Zero();  // tonne mm/s
  double angular = 0.0;
};
Momentum momentum_of(const Scene& scene, const State& state);

/// Greatest distance between the same particles, mm.
double distance_between(const State& one, const State& other);

/// As in tables and pages.
std::string name_of(RunStatus::Kind kind);
std::string name_of(CrushMode mode);

/// Which bits a kernel gives: "fused" with fused multiply-add, else "separate". All kernels of either give the same
/// (GoldenHash).
std::string bits_of_target(const std::string& target);

/// The best kernel of either bits; of a processor without fused multiply-add only one.
std::vector<std::string> distinct_targets();

/// Calls visit() with every kernel that the processor has, one after the other.
template <class Visit>
void for_every_target(Visit&& visit) {
  for (const std::string& target : simd_targets()) {
    SCOPED_TRACE(target);
    ASSERT_TRUE(use_simd_target(target));
    visit();
  }
  ASSERT_TRUE(use_simd_target(""));
}

}  // namespace cellcrush::scenes
