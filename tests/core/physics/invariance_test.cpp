// Mechanics does not depend on who describes it: Galileo's invariances and those of the dimensions. A test of them
// needs no solution. It is blind to whatever all views share, such as a wrong constant without dimension.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/every_target.h"
#include "scenes/evidence.h"
#include "scenes/struck_frame.h"

namespace cellcrush::invariance {
namespace {

using scenes::StruckFrame;
using scenes::View;

/// What a run of the struck frame came to, as its view has it.
struct Outcome {
  std::vector<Vector2> position;
  std::vector<double> rotation;
  Energies energies;
  double time = 0.0;
  std::int64_t touching_steps = 0;
};

Outcome run(const View& view) {
  const auto scene = StruckFrame::scene(view);
  Simulation simulation(scene);
  Outcome outcome;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    outcome.touching_steps += simulation.state().contact_totals.count > 0 ? 1 : 0;
  }
  EXPECT_EQ(simulation.step(), scene->schedule.step_count) << simulation.status().message;
  outcome.energies = evaluate_energies(*scene, simulation.state());
  outcome.time = simulation.time();
  for (int i = 0; i < StruckFrame::kNodes; ++i) {
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
  for (int i = 0; i < StruckFrame::kNodes; ++i) {
    const Vector2 expected = view.length * view.turned(plain.position[i]) + seen.time * view.boost;
    worst = std::max({worst, (seen.position[i] - expected).norm() / (StruckFrame::kHeight * view.length),
                      std::abs(seen.rotation[i] - sense * plain.rotation[i])});
  }
  EXPECT_EQ(seen.touching_steps, plain.touching_steps);
  EXPECT_LT(worst, 1e-9);
  scenes::record_bound("relative difference", worst);
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
