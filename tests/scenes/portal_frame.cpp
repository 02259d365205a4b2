#include "scenes/portal_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

constexpr double kLength = PortalFrame::kLength;
constexpr double kLoadUnit = PortalFrame::kFullMoment / kLength;  // N
constexpr int kCorner = 1;
constexpr int kMiddle = 2;

/// The frame with a dead load that rises over the first third, and a node moved over the rest.
SceneSpec portal(const FrameLattice::NodalLoad& dead, int moved_node, Component moved, double way, int elements) {
  const double wave_speed = std::sqrt(PortalFrame::kModulus / 7.85e-9);
  const double frequency = 3.516 * wave_speed * PortalFrame::kThickness / std::sqrt(12.0) / (kLength * kLength);
  const double end = 60.0 * 2.0 * std::numbers::pi / frequency;
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0},
                 {0.0, kLength, 0.0, 0.0},
                 {0.5 * kLength, kLength, 0.0, 0.0},
                 {kLength, kLength, 0.0, 0.0},
                 {kLength, 0.0, 0.0, 0.0}};
  for (int i = 0; i < 4; ++i) {
    const bool is_half = i == 1 || i == 2;
    frame.beams.push_back(beam(i, i + 1, PortalFrame::kThickness, is_half ? elements / 2 : elements));
  }
  frame.supports = {{0, true, true, true}, {4, true, true, true}};
  frame.loads = {dead};
  frame.loads.front().points = {{0.0, 0.0}, {end / 3.0, dead.points.front().second}};
  frame.motions = {{moved_node, moved, {{end / 3.0, 0.0}, {end, way}}}};
  frame.watched_nodes = {moved_node, dead.node};
  frame.end_time_s = end;
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = PortalFrame::kModulus;
  spec.material.yield_stress_mpa = PortalFrame::kYieldStress;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.numerics.mass_damping_per_s = 0.1 * frequency;
  spec.output.sample_count = 600;
  return spec;
}

/// What the moved node bears by plastic theory.
double collapse_load(PortalFrame::Mechanism mechanism, double displacement, double dead_load) {
  const double dead = dead_load * kLoadUnit;
  if (mechanism == PortalFrame::Mechanism::beam) {
    return 8.0 * kLoadUnit / std::cos(std::asin(std::abs(displacement) / (0.5 * kLength)));
  }
  const double turn = std::asin(displacement / kLength);
  if (mechanism == PortalFrame::Mechanism::sway) {
    return (4.0 * kLoadUnit - dead * std::sin(turn)) / std::cos(turn);
  }
  return (6.0 * kLoadUnit - dead * (std::sin(turn) + 0.5 * std::cos(turn))) / std::cos(turn);
}

}  // namespace

SceneSpec PortalFrame::swayed(double vertical_load, double sway, int elements) {
  return portal({kMiddle, Component::y, {{0.0, -vertical_load * kLoadUnit}}}, kCorner, Component::x, sway, elements);
}

SceneSpec PortalFrame::sagged(double horizontal_load, double sag, int elements) {
  return portal({kCorner, Component::x, {{0.0, horizontal_load * kLoadUnit}}}, kMiddle, Component::y, -sag, elements);
}

double expect_portal_collapse(const std::vector<Sample>& samples, PortalFrame::Mechanism mechanism, double dead_load) {
  const bool is_beam = mechanism == PortalFrame::Mechanism::beam;
  const auto moved = is_beam ? &WatchedNode::uy : &WatchedNode::ux;
  const auto loaded = is_beam ? &WatchedNode::ux : &WatchedNode::uy;
  const double dead = (is_beam ? 1.0 : -1.0) * dead_load * kLoadUnit;
  const Sample& last = samples.back();
  const Sample& before = samples[samples.size() * 4 / 5];
  const double way = last.watched[0].*moved - before.watched[0].*moved;
  const double dead_work = dead * (last.watched[1].*loaded - before.watched[1].*loaded);
  const double load = (last.work_external - before.work_external - dead_work) / way;
  const double middle = 0.5 * (last.watched[0].*moved + before.watched[0].*moved);
  const double ratio = std::abs(load) / collapse_load(mechanism, middle, dead_load);
  // The theory knows no axial force. Members here bear n up to 0.05 of their yield force, and the interaction of the 6
  // depth points begins as 1 - 0.3 n, where 1 - n^2 is exact.
  EXPECT_NEAR(ratio, 1.0, 0.02) << "dead load " << dead_load << " M_p / L";
  return ratio;
}

}  // namespace cellcrush::scenes
