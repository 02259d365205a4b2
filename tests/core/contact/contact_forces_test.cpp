#include "contact/contact_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/direction.h"
#include "scenes/probe.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::Probe;

// Along a leg, round the joint and back along the other leg; the sharper the joint, the nearer is the leg behind it.
TEST(Contact, ForceRoundAJointIsContinuousHoweverSharp) {
  for (const double angle : {2.0, 10.0, 60.0, 120.0, 170.0}) {  // degrees between the legs
    const double half = 0.5 * angle * std::numbers::pi / 180.0;
    const Vector2 upper = -direction(-half);
    const Vector2 lower = -direction(half);
    Probe probe({80.0 * upper, {0.0, 0.0}, 80.0 * lower});
    const double ways = 10.0 + Probe::kDistance * (std::numbers::pi - 2.0 * half);
    for (double way = -10.0; way < ways; way += 0.01) {
      const double turn = std::clamp(way / Probe::kDistance, 0.0, std::numbers::pi - 2.0 * half);
      const Vector2 normal = direction(0.5 * std::numbers::pi - half - turn);
      const Vector2 along = way < 0.0 ? Vector2(-way * upper) : Vector2((way - Probe::kDistance * turn) * lower);
      const Vector2 force = probe.force_at(along + Probe::kDistance * normal, normal);
      ASSERT_NEAR((force - probe.stiffness() * Probe::kDepth * normal).norm(), 0.0, 1e-9 * probe.stiffness())
          << angle << " at " << way;
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
    const Vector2 force = probe.force_at(foot + Probe::kDistance * normal, normal);
    ASSERT_NEAR((force - probe.stiffness() * Probe::kDepth * normal).norm(), 0.0, 1e-9 * probe.stiffness()) << way;
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
  int touching = 0;
  for (double x = -10.0; x < 25.0; x += 0.113) {
    const double ground = x < 0.0 ? 0.4 * x : x < 6.0 ? -x / 6.0 : x < 12.0 ? -1.0 + (x - 6.0) * 2.0 / 3.0 : 3.0;
    const Vector2 place(x, ground + 0.93);
    const auto stored_at = [&](const Vector2& where) {
      probe.force_at(where, outward);
      return probe.state().contact_totals.stored;
    };
    const double reach = 1e-6;
    const Vector2 gradient(
        (stored_at(place + Vector2(reach, 0.0)) - stored_at(place - Vector2(reach, 0.0))) / (2 * reach),
        (stored_at(place + Vector2(0.0, reach)) - stored_at(place - Vector2(0.0, reach))) / (2 * reach));
    const Vector2 force = probe.force_at(place, outward);
    touching += force.norm() > 0.0 ? 1 : 0;
    EXPECT_NEAR((force + gradient).norm(), 0.0, 1e-4 * probe.stiffness()) << x;
  }
  EXPECT_GT(touching, 250);
}

TEST(Contact, RemembersTheSideOfABallPressedPastTheMidLine) {
  Probe probe({{-20.0, 0.0}, {20.0, 0.0}});
  EXPECT_GT(probe.force_at({1.0, 0.5}, {0.0, 1.0}).y(), 0.0);
  const Vector2 through = probe.force_at({1.0, -0.2}, {0.0, 1.0});
  EXPECT_NEAR(through.y(), probe.stiffness() * 1.2, 1e-6);
  probe.force_at({1.0, 5.0}, {0.0, 1.0});                        // left: forgotten
  EXPECT_LT(probe.force_at({1.0, -0.2}, {0.0, -1.0}).y(), 0.0);  // touched again, from the other side
}

TEST(Contact, ForcesOnBallAndSegmentBalanceInForceAndMoment) {
  Probe probe({{-20.0, -3.0}, {20.0, 4.0}});
  const Vector2 axis = Vector2(40.0, 7.0).normalized();
  const Vector2 force = probe.force_at(Vector2(4.0, 1.2) + 0.8 * normal_of(axis), normal_of(axis));
  ASSERT_GT(force.norm(), 0.0);
  Vector2 sum = Vector2::Zero();
  double moment = 0.0;
  for (std::size_t i = 0; i < probe.scene().particle_count(); ++i) {
    sum += probe.state().contact_force[i].elastic;
    moment += cross(probe.state().position[i], probe.state().contact_force[i].elastic);
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-9 * force.norm());
  EXPECT_NEAR(moment, 0.0, 1e-6 * force.norm());
}

TEST(Contact, NeighboursAtAJointDoNotTouchUntilTheWallsFold) {
  // The beam beside the joint is shorter than the walls are thick: at rest this is a joint, not a contact.
  Probe probe({{-20.0, 0.0}, {0.0, 0.0}, {0.6, 0.6}, {20.0, 0.6}});
  probe.force_at({0.0, 500.0}, {0.0, 1.0});
  for (std::size_t i = 0; i < probe.scene().particle_count(); ++i) {
    EXPECT_EQ(probe.state().contact_force[i].elastic.norm(), 0.0) << i;
  }
}

}  // namespace
}  // namespace cellcrush
