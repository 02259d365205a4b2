// The paper's contact at joints (Eq. 41), written as it stands, beside the solver's on the same chains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "contact/touch/force_laws.h"
#include "scenes/frames.h"
#include "scenes/probe.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::Probe;

enum class Ends { open, round };

/// Sum of k D over all segments of a chain, each for itself: a segment ends at its nodes, or is a capsule.
Vector2 force_of_every_segment(const std::vector<Vector2>& chain, const Vector2& place, double stiffness, Ends ends) {
  Vector2 force = Vector2::Zero();
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const double length = (chain[i + 1] - chain[i]).norm();
    const Vector2 axis = (chain[i + 1] - chain[i]) / length;
    const double along = axis.dot(place - chain[i]);
    const Projection foot = project(place, chain[i], axis, length);
    const double distance = foot.offset.norm();
    if (distance < Probe::kThickness && (ends == Ends::round || (along >= 0.0 && along <= length))) {
      force += stiffness * (Probe::kThickness - distance) * foot.offset / distance;
    }
  }
  return force;
}

// A ball that goes round a convex joint at one depth falls into a gap between the ends, and is born deep on the other
// side.
TEST(DeadZone, OfSegmentsThatEndAtTheirNodesIsTheWholeFanOfAConvexJoint) {
  const double bend = std::numbers::pi / 3.0;
  const std::vector<Vector2> chain = {-20.0 * direction(-bend), {0.0, 0.0}, {20.0, 0.0}};
  Probe probe(chain);
  int dropped = 0;
  int places = 0;
  for (double fan = 1.5 * std::numbers::pi - bend + 0.01; fan < 1.5 * std::numbers::pi; fan += 0.01) {
    const Vector2 place = Probe::kDistance * direction(fan);
    const Vector2 literal = force_of_every_segment(chain, place, probe.stiffness(), Ends::open);
    dropped += literal.norm() == 0.0 ? 1 : 0;
    ++places;
    const Vector2 force = probe.force_at(place, direction(fan));
    EXPECT_NEAR(force.norm(), probe.stiffness() * Probe::kDepth, 1e-9 * force.norm()) << fan;
  }
  EXPECT_EQ(dropped, places);
}

// Round ends alone push twice over the node of a straight chain, and every joint is a bump.
TEST(DoubleForce, OfRoundEndsMakesABumpOfEveryJointOfAStraightChain) {
  const std::vector<Vector2> chain = {{0.0, 0.0}, {5.0, 0.0}, {10.0, 0.0}, {15.0, 0.0}, {20.0, 0.0}};
  Probe probe(chain);
  const double once = probe.stiffness() * Probe::kDepth;
  double most = 0.0;
  for (double x = 1.0; x < 19.0; x += 0.037) {
    const Vector2 place(x, Probe::kDistance);
    most = std::max(most, force_of_every_segment(chain, place, probe.stiffness(), Ends::round).y());
    EXPECT_NEAR(probe.force_at(place, {0.0, 1.0}).y(), once, 1e-9 * once) << x;
  }
  EXPECT_GT(most, 1.9 * once);
}

// In a groove both legs push, more than either is deep: the force is no longer k D along one normal. At its bottom,
// where both are equally deep, each leg has a half of it.
TEST(DoubleForce, OfBothLegsOfAShallowGrooveIsTwiceThatOfOne) {
  const double half = 0.5 * 170.0 * std::numbers::pi / 180.0;
  const std::vector<Vector2> chain = {
      30.0 * direction(0.5 * std::numbers::pi + half), {0.0, 0.0}, 30.0 * direction(0.5 * std::numbers::pi - half)};
  Probe probe(chain);
  const Vector2 bottom(0.0, Probe::kDistance / std::sin(half));
  const double once = probe.stiffness() * Probe::kDepth;
  EXPECT_GT(force_of_every_segment(chain, bottom, probe.stiffness(), Ends::round).norm(), 1.9 * once);
  EXPECT_NEAR(probe.force_at(bottom, {0.0, 1.0}).norm(), once * std::sin(half), 1e-9 * once);
}

}  // namespace
}  // namespace cellcrush
