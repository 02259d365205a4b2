// The forces on a ball that is led along a chain of elements by hand: normal, and friction that sticks or slides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/frames.h"
#include "scenes/probe.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::Probe;

/// The way of a ball along the upper leg of a joint, round it and back along the lower one, at one depth.
struct WayRoundAJoint {
  double half;  // of the angle between the legs, rad
  Vector2 upper = -direction(-half);
  Vector2 lower = -direction(half);

  explicit WayRoundAJoint(double degrees) : half(0.5 * degrees * std::numbers::pi / 180.0) {}

  [[nodiscard]] std::vector<Vector2> chain() const { return {80.0 * upper, {0.0, 0.0}, 80.0 * lower}; }
  [[nodiscard]] double end_of_turn() const { return Probe::kDistance * (std::numbers::pi - 2.0 * half); }
  /// At a way from the joint; before it the way is negative.
  [[nodiscard]] Vector2 normal(double way) const {
    return direction(0.5 * std::numbers::pi - half - std::clamp(way, 0.0, end_of_turn()) / Probe::kDistance);
  }
  [[nodiscard]] Vector2 place(double way) const {
    const Vector2 along = way < 0.0 ? Vector2(-way * upper) : Vector2(std::max(0.0, way - end_of_turn()) * lower);
    return along + Probe::kDistance * normal(way);
  }
};

void expect_full_force(Probe& probe, const Vector2& place, const Vector2& normal, double way) {
  const Vector2 force = probe.force_at(place, normal);
  ASSERT_NEAR((force - probe.stiffness() * Probe::kDepth * normal).norm(), 0.0, 1e-9 * probe.stiffness()) << way;
}

// The sharper the joint, the nearer is the leg behind it.
TEST(Contact, ForceRoundAJointIsContinuousHoweverSharp) {
  for (const double angle : {2.0, 10.0, 60.0, 120.0, 170.0}) {  // degrees between the legs
    const WayRoundAJoint at(angle);
    Probe probe(at.chain());
    for (double way = -10.0; way < 10.0 + at.end_of_turn(); way += 0.01) {
      expect_full_force(probe, at.place(way), at.normal(way), way);
    }
  }
}

// The side that a ball came from is no longer its side once it has gone round the end.
TEST(Contact, BallThatGoesRoundAFreeEndIsPushedAwayOnTheOtherSide) {
  Probe probe({{-20.0, 0.0}, {0.0, 0.0}});
  for (double way = -5.0; way < 5.0 + Probe::kDistance * std::numbers::pi; way += 0.01) {
    const double turn = std::clamp(way / Probe::kDistance, 0.0, std::numbers::pi);
    const Vector2 normal = direction(0.5 * std::numbers::pi - turn);
    const Vector2 foot(way < 0.0 ? way : Probe::kDistance * turn - way, 0.0);
    expect_full_force(probe, foot + Probe::kDistance * normal, normal, way);
  }
}

// Both legs of a groove touch a ball at its bottom; the deeper one pushes, so the force is never more than k D of it
// and changes from one normal to the other where both are as deep.
TEST(Contact, ForceInAGrooveIsThatOfTheDeeperLeg) {
  for (const double angle : {40.0, 90.0, 150.0, 179.0}) {
    const double half = 0.5 * angle * std::numbers::pi / 180.0;
    const Vector2 right = direction(0.5 * std::numbers::pi - half);
    const Vector2 left = direction(0.5 * std::numbers::pi + half);
    Probe probe({30.0 * left, {0.0, 0.0}, 30.0 * right});
    const double bottom = Probe::kDistance / std::sin(half);
    for (double x = -0.05; x < 0.05; x += 0.00049) {
      const Vector2 place(x, bottom);
      const double left_depth = Probe::kThickness + cross(left, place);
      const double right_depth = Probe::kThickness - cross(right, place);
      // Legs whose depths differ by no more than 1e-6 h have a half each.
      const double lead = (left_depth - right_depth) / Probe::kThickness;
      const double of_left = std::abs(lead) <= 1e-6 ? 0.5 : lead > 0.0 ? 1.0 : 0.0;
      const Vector2 deep = -of_left * left_depth * normal_of(left) + (1.0 - of_left) * right_depth * normal_of(right);
      const Vector2 force = probe.force_at(place, {0.0, 1.0});
      EXPECT_NEAR((force - probe.stiffness() * deep).norm(), 0.0, 1e-9 * probe.stiffness()) << angle << x;
    }
  }
}

// What a lossless contact gives back is what it took, on whatever way: the force is the gradient of the stored energy.
TEST(Contact, ForceIsTheGradientOfTheStoredEnergyRoundAKinkedChain) {
  Probe probe({{-20.0, -8.0}, {0.0, 0.0}, {6.0, -1.0}, {12.0, 3.0}, {30.0, 3.0}});
  const Vector2 outward(0.0, 1.0);
  const auto stored_at = [&](const Vector2& where) {
    probe.force_at(where, outward);
    return probe.state().contact_totals.stored;
  };
  int touching = 0;
  for (double x = -10.0; x < 25.0; x += 0.113) {
    const double ground = x < 0.0 ? 0.4 * x : x < 6.0 ? -x / 6.0 : x < 12.0 ? -1.0 + (x - 6.0) * 2.0 / 3.0 : 3.0;
    const Vector2 place(x, ground + 0.93);
    const double reach = 1e-6;
    Vector2 gradient;
    for (const int axis : {0, 1}) {
      const Vector2 way = reach * Vector2::Unit(axis);
      gradient[axis] = (stored_at(place + way) - stored_at(place - way)) / (2 * reach);
    }
    const Vector2 force = probe.force_at(place, outward);
    touching += force.norm() > 0.0 ? 1 : 0;
    EXPECT_NEAR((force + gradient).norm(), 0.0, 1e-4 * probe.stiffness()) << x;
  }
  EXPECT_GT(touching, 250);
}

constexpr double kSticks = 100.0;  // as friction
constexpr double kStep = 1e-3;     // mm of drag a step

// From x = -0.5 to 0.5 mm over the joint at x = 0 of a straight chain. What sticks has the force of its whole slip;
// what slides does from 0.03 mm on.
TEST(FrictionHistory, LosesNothingAtAJointWhicheverWayItsSegmentsRun) {
  for (const double coefficient : {kSticks, 0.3}) {
    for (const int reversed : {0, 1, 2, 3}) {
      Probe probe({{-20.0, 0.0}, {0.0, 0.0}, {20.0, 0.0}}, coefficient, {reversed % 2 == 1, reversed / 2 == 1});
      probe.force_at({-0.5, Probe::kDistance}, {0.0, 1.0});
      for (int i = 1; i <= 1000; ++i) {
        const Vector2 force = probe.drag_to({-0.5 + i * kStep, Probe::kDistance}, {0.0, 1.0});
        const double friction = -std::min(i * kStep, coefficient * Probe::kDepth);
        ASSERT_NEAR(force.y(), 0.0, 1e-9 * probe.stiffness());
        if (coefficient < kSticks && i <= 100) continue;
        ASSERT_NEAR(force.x(), probe.stiffness() * friction, 1e-9 * probe.stiffness()) << reversed << " " << i;
      }
    }
  }
}

// Round a sharp joint the axes of the segments point against each other; the friction goes on along the polyline.
TEST(FrictionHistory, IsCarriedRoundASharpJointAcrossTheNormal) {
  for (const double angle : {10.0, 60.0, 120.0}) {
    for (const bool second : {false, true}) {
      const WayRoundAJoint at(angle);
      Probe probe(at.chain(), kSticks, {false, second});
      probe.force_at(at.place(-0.5), at.normal(-0.5));
      double slipped = 0.0;
      for (double way = -0.5 + kStep; way < 0.5 + at.end_of_turn(); way += kStep) {
        slipped += kStep;
        const Vector2 force = probe.drag_to(at.place(way), at.normal(way));
        // A step round the end is a chord of the arc: short by a relative 5e-8.
        ASSERT_NEAR((force - probe.stiffness() * slipped * normal_of(at.normal(way))).norm(), 0.0,
                    1e-5 * probe.stiffness())
            << angle << second << way;
      }
    }
  }
}

TEST(FrictionHistory, BeginsAnewWhereABallHasLeft) {
  Probe probe({{-20.0, 0.0}, {20.0, 0.0}}, kSticks);
  const Vector2 up(0.0, 1.0);
  probe.force_at({0.0, Probe::kDistance}, up);
  EXPECT_LT(probe.drag_to({0.1, Probe::kDistance}, up).x(), 0.0);
  probe.force_at({0.1, 2.0}, up);
  probe.force_at({0.1, Probe::kDistance}, up);
  EXPECT_NEAR(probe.drag_to({0.2, Probe::kDistance}, up).x(), -0.1 * probe.stiffness(), 1e-9 * probe.stiffness());
}

}  // namespace
}  // namespace cellcrush
