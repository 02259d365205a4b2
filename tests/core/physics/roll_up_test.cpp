#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

using scenes::Cantilever;

struct RolledTip {
  Vector2 place;  // over L
  double turn;    // rad
};

/// Where the tip comes to rest when an end moment mu EI / L bends the cantilever into an arc of the angle mu.
RolledTip roll_under(double mu, int elements) {
  const double moment = mu * Cantilever::kStiffness / Cantilever::kLength;
  const double time_unit = 1.0 / Cantilever::first_frequency();
  const auto scene = scenes::build(
      Cantilever::spec(elements, FrameLattice::Component::rotation, moment, 10.0 * time_unit, 28.0 * time_unit));
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  return {simulation.state().position[1] / Cantilever::kLength, simulation.state().rotation[1]};
}

double error_of(double mu, int elements) {
  const RolledTip tip = roll_under(mu, elements);
  EXPECT_NEAR(tip.turn, mu, 1e-3 * mu) << mu;  // counts whole turns
  return (tip.place - Vector2(std::sin(mu) / mu, (1.0 - std::cos(mu)) / mu)).norm();
}

TEST(RollUp, EndMomentBendsTheCantileverIntoItsExactArcUpToTwoTurns) {
  double worst = 0.0;
  for (const double turns : {0.25, 0.5, 1.0, 1.5, 2.0}) {
    const double error = error_of(2.0 * std::numbers::pi * turns, 32);
    worst = std::max(worst, error);
    EXPECT_LT(error, 2e-3) << turns << " turns";
  }
  scenes::record_figure("worst error over L", worst, 2);
}

TEST(RollUp, ErrorFallsAsTheSquareOfTheElements) {
  const double coarse = error_of(std::numbers::pi, 8);
  const double fine = error_of(std::numbers::pi, 16);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " to " << fine;
}

}  // namespace
}  // namespace cellcrush
