// Mechanics does not depend on who describes it: Galileo's invariances and those of the dimensions. A test of them
// needs no solution. It is blind to whatever all views share, such as a wrong constant without dimension.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::invariance {
namespace {

/// A plastic frame with two legs, whose top is pushed down and aside while a free bar flies into a leg: beams of odd
/// and even numbers of elements, contact with friction and damping, mixed hardening, gravity, a load, a moment, a line
/// load and an attached mass. It ends after `kEnd` s.
constexpr int kNodes = 8;
constexpr double kHeight = 45.0;  // mm
constexpr double kEnd = 8e-4;     // s, before a change of units
constexpr int kTop = 4;
constexpr int kBar = 5;  // first of its three nodes

/// Another description of the same problem. Mechanics does not depend on it.
struct View {
  double angle = 0.0;          ///< rad, by which everything is turned, after the mirror
  bool mirrored = false;       ///< x becomes -x
  Vector2 boost = {0.0, 0.0};  ///< mm/s, added to every velocity, that of the supports too
  double length = 1.0;         ///< factors of the units: all quantities follow by their dimensions
  double stress = 1.0;
  double time = 1.0;
  bool renumbered = false;  ///< nodes in reverse, beams shuffled, every other beam from its end to its start

  /// A vector of the problem as this view has it, without a change of units.
  [[nodiscard]] Vector2 turned(const Vector2& vector) const {
    const double x = mirrored ? -vector.x() : vector.x();
    return x * scenes::direction(angle) + vector.y() * normal_of(scenes::direction(angle));
  }
  /// The number of a node in this view.
  [[nodiscard]] int node(int number) const { return renumbered ? kNodes - 1 - number : number; }
};

using Component = FrameLattice::Component;

/// Writes the parts of a frame as a view has them.
class FrameWriter {
 public:
  explicit FrameWriter(const View& view) : view_(view), force_(view.stress * view.length * view.length) {}

  void node(double x, double y, double mass) {
    const Vector2 place = view_.length * view_.turned({x, y});
    const double attached = mass * density() * std::pow(view_.length, 3) * 1e6;
    frame.nodes.push_back({place.x(), place.y(), attached, 0.5 * attached * view_.length * view_.length});
  }

  void beam(int start, int end, double thickness, int elements) {
    frame.beams.push_back(scenes::beam(start, end, thickness * view_.length, elements));
  }

  /// A node that goes steadily to `way`, or is held where that is 0, and moves with the boost.
  void moved_node(int node, const Vector2& way, bool fix_rotation) {
    const bool held = way.isZero() && view_.boost.isZero();
    frame.supports.push_back({node, held, held, fix_rotation});
    if (held) return;
    const double end = 1.1 * kEnd * view_.time;
    const Vector2 travel = view_.length * view_.turned(1.1 * way) + end * view_.boost;
    frame.motions.push_back({node, Component::x, {{0.0, 0.0}, {end, travel.x()}}});
    frame.motions.push_back({node, Component::y, {{0.0, 0.0}, {end, travel.y()}}});
  }

  void velocity(int node, const Vector2& velocity, double spin) {
    const Vector2 speed = (view_.length / view_.time * view_.turned(velocity) + view_.boost) * 1e-3;
    frame.initial_velocities.push_back({node, speed.x(), speed.y(), sense() * spin / view_.time});
  }

  void load(int node, const Vector2& force, double moment) {
    const Vector2 turned = force_ * view_.turned(force);
    frame.loads.push_back({node, Component::x, {{0.0, turned.x()}}});
    frame.loads.push_back({node, Component::y, {{0.0, turned.y()}}});
    frame.loads.push_back({node, Component::rotation, {{0.0, sense() * force_ * view_.length * moment}}});
  }

  void line_load(int beam, const Vector2& load) {
    const Vector2 turned = force_ / view_.length * view_.turned(load);
    frame.distributed_loads.push_back({beam, {{0.0, turned.x()}}, {{0.0, turned.y()}}});
  }

  void gravity(const Vector2& gravity) {
    const Vector2 turned = view_.length / (view_.time * view_.time) * view_.turned(gravity) * 1e-3;
    frame.gravity_x_m_per_s2 = turned.x();
    frame.gravity_y_m_per_s2 = turned.y();
  }

  /// Factor of the density.
  [[nodiscard]] double density() const { return view_.stress * std::pow(view_.time / view_.length, 2); }

  FrameLattice frame;

 private:
  [[nodiscard]] double sense() const { return view_.mirrored ? -1.0 : 1.0; }

  const View& view_;
  double force_;
};

void renumber(const View& view, FrameLattice& frame) {
  const auto rename = [&](auto& items) {
    for (auto& item : items) item.node = view.node(item.node);
    std::ranges::reverse(items);
  };
  std::ranges::reverse(frame.nodes);
  rename(frame.supports);
  rename(frame.loads);
  rename(frame.motions);
  rename(frame.initial_velocities);
  constexpr std::array kOrder = {3, 0, 5, 2, 4, 6, 1};  // the beam that comes to each place
  const std::vector<FrameLattice::Beam> beams = frame.beams;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    FrameLattice::Beam& beam = frame.beams[i];
    beam = beams[kOrder[i]];
    beam.start = view.node(beam.start);
    beam.end = view.node(beam.end);
    if (i % 2 == 0) std::swap(beam.start, beam.end);
  }
  for (FrameLattice::DistributedLoad& load : frame.distributed_loads) {
    load.beam = static_cast<int>(std::ranges::find(kOrder, load.beam) - kOrder.begin());
  }
}

SceneSpec struck_frame(const View& view) {
  FrameWriter writer(view);
  constexpr std::array<std::array<double, 3>, kNodes> kPlaces = {{{0.0, 0.0, 0.0},
                                                                  {30.0, 2.0, 0.0},
                                                                  {3.0, 25.0, 1e-7},
                                                                  {28.0, 24.0, 0.0},
                                                                  {14.0, 45.0, 0.0},
                                                                  {10.0, 12.0, 0.0},
                                                                  {15.0, 13.5, 0.0},
                                                                  {20.0, 15.0, 0.0}}};
  for (const auto& [x, y, mass] : kPlaces) writer.node(x, y, mass);
  writer.beam(0, 2, 1.0, 4);
  writer.beam(1, 3, 1.0, 3);
  writer.beam(2, 3, 1.0, 4);
  writer.beam(2, kTop, 0.8, 2);
  writer.beam(3, kTop, 0.8, 3);
  writer.beam(kBar, kBar + 1, 1.2, 1);
  writer.beam(kBar + 1, kBar + 2, 1.2, 1);
  writer.moved_node(0, {0.0, 0.0}, true);
  writer.moved_node(1, {0.0, 0.0}, true);
  writer.moved_node(kTop, {2.0, -9.0}, false);
  for (int i = 0; i < kBar; ++i) writer.velocity(i, {0.0, 0.0}, 0.0);
  for (int i = 0; i < 3; ++i) writer.velocity(kBar + i, {55e3 - 600.0 * i, 21e3 + 2000.0 * i}, 400.0);
  writer.load(3, {4.0, -2.0}, 15.0);
  writer.line_load(2, {0.05, -0.1});
  writer.gravity({2e5, -4e6});
  FrameLattice frame = std::move(writer.frame);
  frame.self_contact = true;
  frame.end_time_s = kEnd * view.time;
  if (view.renumbered) renumber(view, frame);
  SceneSpec spec = scenes::in_double_precision(scenes::plastic_frame(
      std::move(frame), 70000.0 * view.stress, 90.0 * view.stress, scenes::kDensity * writer.density()));
  spec.depth_mm = 2.0 * view.length;
  spec.material.hardening_modulus_mpa = 900.0 * view.stress;
  spec.material.isotropic_fraction = 0.4;
  spec.contact.friction = 0.3;
  return spec;
}

/// What a run of the struck frame came to, as its view has it.
struct Outcome {
  std::vector<Vector2> position;
  std::vector<double> rotation;
  Energies energies;
  double time = 0.0;
  std::int64_t touching_steps = 0;
};

Outcome run(const View& view) {
  const auto scene = scenes::build(struck_frame(view));
  Simulation simulation(scene);
  Outcome outcome;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    outcome.touching_steps += simulation.state().contact_totals.count > 0 ? 1 : 0;
  }
  EXPECT_EQ(simulation.step(), scene->schedule.step_count) << simulation.status().message;
  outcome.energies = evaluate_energies(*scene, simulation.state());
  outcome.time = simulation.time();
  for (int i = 0; i < kNodes; ++i) {
    outcome.position.push_back(simulation.state().position[view.node(i)]);
    outcome.rotation.push_back(simulation.state().rotation[view.node(i)]);
  }
  return outcome;
}

Outcome plain_run() {
  Outcome outcome = run({});
  EXPECT_GT(outcome.energies.plastic, 500.0) << "the frame must yield";
  EXPECT_GT(outcome.touching_steps, 100) << "the bar must touch it";
  EXPECT_GT(outcome.energies.friction, 5.0);
  EXPECT_GT(outcome.energies.contact_damping, 5.0);
  return outcome;
}

/// Worst difference of the energies of two runs after the units are changed back, over the plastic work. The kinetic
/// energy and the works of the supports depend on the boost; their residual does not.
double energies_apart(const Energies& seen, const Energies& plain, double unit) {
  const auto apart = [&](double here, double there) { return std::abs(here / unit - there) / plain.plastic; };
  return std::max({apart(seen.elastic, plain.elastic), apart(seen.plastic, plain.plastic),
                   apart(seen.contact, plain.contact), apart(seen.contact_damping, plain.contact_damping),
                   apart(seen.friction, plain.friction), apart(seen.residual, plain.residual)});
}

/// Holds a view of the struck frame to the plain one: places over the frame's height, rotations in rad, energies over
/// the plastic work. Round-off grows where the bar touches and slides; a real difference is of the order of 1.
void expect_same_outcome(const View& view) {
  const Outcome plain = plain_run();
  const Outcome seen = run(view);
  const double sense = view.mirrored ? -1.0 : 1.0;
  double worst = energies_apart(seen.energies, plain.energies, view.stress * std::pow(view.length, 3));
  for (int i = 0; i < kNodes; ++i) {
    const Vector2 expected = view.length * view.turned(plain.position[i]) + seen.time * view.boost;
    worst = std::max({worst, (seen.position[i] - expected).norm() / (kHeight * view.length),
                      std::abs(seen.rotation[i] - sense * plain.rotation[i])});
  }
  EXPECT_EQ(seen.touching_steps, plain.touching_steps);
  scenes::record_bound("relative difference", worst, 1e-9);
}

void expect_the_same(const View& view) {
  scenes::for_every_target([&] { expect_same_outcome(view); });
}

TEST(Invariance, TheStruckFrameMayBeTurnedByAnyAngle) {
  for (const double angle : {0.5, 2.0, -2.5}) expect_the_same({.angle = angle});
}

TEST(Invariance, TheStruckFrameMayBeMirrored) {
  expect_the_same({.mirrored = true});
  expect_the_same({.angle = 1.1, .mirrored = true});
}

// The boost is forty times the speed of the frame's top and three times that of the bar.
TEST(Invariance, TheStruckFrameMayBeSeenFromAMovingPlace) { expect_the_same({.boost = {2e5, -1.3e5}}); }

TEST(Invariance, TheNodesAndBeamsOfTheStruckFrameMayBeNumberedOtherwise) { expect_the_same({.renumbered = true}); }

// Three times as large, in three times the time: the stresses are the same (Cauchy's similarity). Gravity is a third.
TEST(Invariance, AStruckFrameOfThreeTimesTheSizeTakesThreeTimesAsLong) {
  expect_the_same({.length = 3.0, .time = 3.0});
}

// Any three factors of length, stress and time: no constant of the solver has a dimension.
TEST(Invariance, TheUnitsOfLengthStressAndTimeAreFree) {
  expect_the_same({.length = 3.0, .stress = 2.5, .time = 0.7});
  expect_the_same({.length = 0.1, .stress = 0.01, .time = 0.02});
}

}  // namespace
}  // namespace cellcrush::invariance
