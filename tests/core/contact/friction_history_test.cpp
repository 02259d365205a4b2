#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/direction.h"
#include "scenes/probe.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::Probe;

constexpr double kStep = 1e-3;  // mm of drag a step

/// Friction at each step of a drag over the joint at x = 0 of a straight chain, from x = -0.5 to 0.5 mm.
std::vector<double> drag_over_joint(double friction, bool first_reversed, bool second_reversed, double& stiffness) {
  Probe probe({{-20.0, 0.0}, {0.0, 0.0}, {20.0, 0.0}}, friction, {first_reversed, second_reversed});
  stiffness = probe.stiffness();
  const Vector2 up(0.0, 1.0);
  probe.force_at({-0.5, Probe::kDistance}, up);
  std::vector<double> result;
  for (int i = 1; i <= 1000; ++i) {
    const Vector2 force = probe.drag_to({-0.5 + i * kStep, Probe::kDistance}, up);
    EXPECT_NEAR(force.y(), 0.0, 1e-9 * stiffness);
    result.push_back(force.x());
  }
  return result;
}

TEST(FrictionHistory, AStickingBallLosesNothingAtAJointWhicheverWayItsSegmentsRun) {
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      double stiffness = 0.0;
      const std::vector<double> friction = drag_over_joint(100.0, first, second, stiffness);
      for (std::size_t i = 0; i < friction.size(); ++i) {
        const double slipped = static_cast<double>(i + 1) * kStep;
        ASSERT_NEAR(friction[i], -stiffness * slipped, 1e-9 * stiffness) << first << second << i;
      }
    }
  }
}

TEST(FrictionHistory, ASlidingBallFeelsTheSameFrictionBeforeAndAfterAJoint) {
  for (const bool second : {false, true}) {
    double stiffness = 0.0;
    const std::vector<double> friction = drag_over_joint(0.3, false, second, stiffness);
    for (std::size_t i = 100; i < friction.size(); ++i) {  // slides from 0.03 mm on
      ASSERT_NEAR(friction[i], -0.3 * stiffness * Probe::kDepth, 1e-9 * stiffness) << second << i;
    }
  }
}

// Round a sharp joint the axes of the segments point against each other; the friction goes on along the polyline.
TEST(FrictionHistory, IsCarriedRoundASharpJointAcrossTheNormal) {
  for (const double angle : {10.0, 60.0, 120.0}) {
    for (const bool second : {false, true}) {
      const double half = 0.5 * angle * std::numbers::pi / 180.0;
      const Vector2 upper = -direction(-half);
      const Vector2 lower = -direction(half);
      Probe probe({80.0 * upper, {0.0, 0.0}, 80.0 * lower}, 100.0, {false, second});
      double slipped = 0.0;
      for (double way = -0.5; way < 0.5 + Probe::kDistance * (std::numbers::pi - 2.0 * half); way += kStep) {
        const double turn = std::clamp(way / Probe::kDistance, 0.0, std::numbers::pi - 2.0 * half);
        const Vector2 normal = direction(0.5 * std::numbers::pi - half - turn);
        const Vector2 along = way < 0.0 ? Vector2(-way * upper) : Vector2((way - Probe::kDistance * turn) * lower);
        const Vector2 place = along + Probe::kDistance * normal;
        if (way == -0.5) {
          probe.force_at(place, normal);
          continue;
        }
        slipped += kStep;
        const Vector2 force = probe.drag_to(place, normal);
        const Vector2 ahead(normal.y(), -normal.x());
        // A step round the end is a chord of the arc: short by a relative 5e-8.
        ASSERT_NEAR((force + probe.stiffness() * slipped * ahead).norm(), 0.0, 1e-5 * probe.stiffness())
            << angle << second << way;
      }
    }
  }
}

TEST(FrictionHistory, BeginsAnewWhereABallHasLeft) {
  Probe probe({{-20.0, 0.0}, {20.0, 0.0}}, 100.0);
  const Vector2 up(0.0, 1.0);
  probe.force_at({0.0, Probe::kDistance}, up);
  EXPECT_LT(probe.drag_to({0.1, Probe::kDistance}, up).x(), 0.0);
  probe.force_at({0.1, 2.0}, up);
  probe.force_at({0.1, Probe::kDistance}, up);
  EXPECT_NEAR(probe.drag_to({0.2, Probe::kDistance}, up).x(), -0.1 * probe.stiffness(), 1e-9 * probe.stiffness());
}

}  // namespace
}  // namespace cellcrush
