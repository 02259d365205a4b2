// Rotations that are not small, and what must not notice them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/kernels.h"
#include "scenes/probe.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::ElementDeformation;
using scenes::Probe;

// A bar that turns 400 steps a turn, for three turns: the angle of its direction jumps by a turn at every half turn,
// and an element whose nodes have not jumped along would be bent by it. The increment of the axis has no such place.
TEST(ManyTurns, TheAngleOfADirectionJumpsWhereTheIncrementOfTheAxisDoesNot) {
  const double turn = 2.0 * std::numbers::pi / 400.0;
  double worst_of_angles = 0.0;
  for (int step = 1; step <= 1200; ++step) {
    const Vector2 before = direction(turn * (step - 1));
    const Vector2 now = direction(turn * step);
    const double of_angles = std::atan2(now.y(), now.x()) - std::atan2(before.y(), before.x());
    worst_of_angles = std::max(worst_of_angles, std::abs(of_angles - turn));
    const ElementDeformation deformation = scenes::reverse_motion(2.0 * now, before, 2.0, turn, turn);
    EXPECT_NEAR(deformation.rotation_start, 0.0, 1e-14) << step;
    EXPECT_NEAR(deformation.rotation_end, 0.0, 1e-14) << step;
  }
  EXPECT_NEAR(worst_of_angles, 2.0 * std::numbers::pi, 1e-9);
}

// A slow spin in the paper's steps: 1e-9 rad a step, for ten million steps. The arc cosine of Eq. 9 sees none of it,
// and the element is bent by all that its nodes have turned.
TEST(SmallIncrements, AreLostToTheArcCosineAndBendAnElementThatOnlySpins) {
  for (const double angle : {1e-9, -1e-9, 3e-12, -3e-12}) {
    const Vector2 to = Vector2(1.0, angle).normalized();
    EXPECT_EQ(std::acos(Vector2(1.0, 0.0).dot(to)), 0.0);
    scenes::record_bound("relative error", scenes::turn_between({1.0, 0.0}, to) / angle - 1.0);
  }
  constexpr double kTurn = 1e-9;
  constexpr int kSteps = 10'000'000;
  double bend_by_arc_cosine = 0.0;
  double bend = 0.0;
  for (int step = 0; step < 1000; ++step) {
    const Vector2 before = direction(0.3 + kTurn * step);
    const Vector2 now = direction(0.3 + kTurn * (step + 1));
    bend_by_arc_cosine += kTurn - std::acos(std::min(1.0, before.dot(now)));
    bend += kTurn - scenes::turn_between(before, now);
  }
  constexpr double kRest = kSteps / 1000.0;
  EXPECT_GT(std::abs(bend_by_arc_cosine) * kRest, 0.005);  // rad: half of the yield rotation of a wall
  EXPECT_LT(std::abs(bend) * kRest, 1e-8);
}

TEST(LargeIncrements, BeyondHalfATurnAreSeenAsTheOtherWay) {
  for (double angle = -3.14; angle <= 3.14; angle += 0.0031) {
    EXPECT_NEAR(scenes::turn_between(direction(0.3), direction(0.3 + angle)), angle, 1e-15 + 2e-16 * std::abs(angle));
  }
  constexpr double kTurn = 3.3;
  EXPECT_NEAR(scenes::turn_between(direction(0.0), direction(kTurn)), kTurn - 2.0 * std::numbers::pi, 1e-12);
  const ElementDeformation deformation =
      scenes::reverse_motion(2.0 * direction(kTurn), direction(0.0), 2.0, kTurn, kTurn);
  EXPECT_NEAR(deformation.rotation_start, 2.0 * std::numbers::pi, 1e-12);  // a rigid turn, felt as a full turn of bend
}

// Two beams in touch, dragged against each other and then turned as one. Friction that is kept as a vector stays where
// it was while the walls turn away from it; kept along the segment it turns with them, and so does the normal force.
TEST(Objectivity, ForcesOfAContactTurnWithItsWalls) {
  constexpr double kApart = 0.9 * Probe::kThickness;
  constexpr double kSticks = 100.0;  // as friction
  const auto forces_at = [&](double angle) {
    const Vector2 along = direction(angle);
    const Vector2 up = normal_of(along);
    Probe probe({-20.0 * along, 20.0 * along}, kSticks);
    probe.force_at(kApart * up, up);
    const Vector2 friction = probe.drag_to(kApart * up + 0.01 * along, up);
    return std::pair(Vector2(probe.state().contact_force[3].elastic), friction);
  };
  const auto [normal, friction] = forces_at(0.0);
  ASSERT_GT(friction.norm(), 0.0);
  for (const double angle : {0.5, 1.5, 3.0, -2.0}) {
    const auto turned = [&](const Vector2& force) {
      return Vector2(force.x() * direction(angle) + force.y() * normal_of(direction(angle)));
    };
    const auto [normal_now, friction_now] = forces_at(angle);
    EXPECT_NEAR((normal_now - turned(normal)).norm(), 0.0, 1e-9 * normal.norm()) << angle;
    EXPECT_NEAR((friction_now - turned(friction)).norm(), 0.0, 1e-9 * friction.norm()) << angle;
    EXPECT_GT((turned(friction) - friction).norm(), 0.4 * friction.norm());  // the error of a vector that is kept
  }
}

}  // namespace
}  // namespace cellcrush
