#include "contact/contact_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/normal_force.h"
#include "scenes/frames.h"
#include "step/integrate_motion.h"

namespace cellcrush {
namespace {

constexpr double kThickness = 1.0;

/// A frame of beams with contact; the last node is the tip of a short probe, which is moved about by hand.
class Probe {
 public:
  explicit Probe(const std::vector<Vector2>& chain) {
    FrameLattice frame;
    for (const Vector2& node : chain) {
      frame.nodes.push_back({node.x(), node.y(), 0.0, 0.0});
    }
    const int count = static_cast<int>(chain.size());
    for (int i = 0; i + 1 < count; ++i) {
      frame.beams.push_back(scenes::beam(i, i + 1, kThickness, 1));
    }
    frame.nodes.push_back({0.0, 1000.0, 0.0, 0.0});
    frame.nodes.push_back({0.0, 990.0, 0.0, 0.0});
    frame.beams.push_back(scenes::beam(count, count + 1, kThickness, 1));
    frame.self_contact = true;
    SceneSpec spec = scenes::elastic_frame(frame);
    spec.contact.damping_ratio = 0.0;
    scene_ = scenes::build(spec);
    state_ = place_particles(*scene_);
    tip_ = count + 1;
  }

  /// Force on the tip when it stands there; its beam points away along `outward`.
  Vector2 force_at(const Vector2& place, const Vector2& outward) {
    state_.position[tip_] = place;
    state_.position[tip_ - 1] = place + 10.0 * outward;
    const std::size_t beam = scene_->element_count() - 1;
    state_.axis[beam] = -outward;
    search_contacts(*scene_, state_);
    evaluate_contact_forces(*scene_, state_);
    return state_.contact_force[tip_];
  }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  State& state() { return state_; }

 private:
  std::shared_ptr<Scene> scene_;
  State state_;
  int tip_ = 0;
};

Vector2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Force by which the chain's own balls push the tip where it is the nearest point of the probe to them.
Vector2 push_of_balls(const Probe& probe, const std::vector<Vector2>& balls, const Vector2& tip,
                      const Vector2& outward) {
  Vector2 sum = Vector2::Zero();
  for (const Vector2& ball : balls) {
    const Vector2 away = tip - ball;
    if (away.norm() < kThickness && outward.dot(ball - tip) <= 0.0) {
      sum += probe.scene().contact.stiffness * (kThickness - away.norm()) * away.normalized();
    }
  }
  return sum;
}

// Eq. 41a drops a ball past a segment's end: at a convex joint it finds nothing to stand on. Tip and joint are both balls:
// each pushes once.
TEST(Contact, ConvexJointHasNoDeadZoneAndEachBallPushesOnce) {
  const double bend = std::numbers::pi / 3.0;
  const double depth = 0.1;
  Probe probe({-20.0 * direction(-bend), {0.0, 0.0}, {20.0, 0.0}});
  for (double fan = 1.5 * std::numbers::pi - bend; fan <= 1.5 * std::numbers::pi; fan += 0.01) {
    const Vector2 place = (kThickness - depth) * direction(fan);
    const Vector2 force = probe.force_at(place, direction(fan));
    const Vector2 expected = 2.0 * probe.scene().contact.stiffness * depth * direction(fan);
    EXPECT_NEAR((force - expected).norm(), 0.0, 1e-9 * force.norm()) << fan;
  }
}

TEST(Contact, BallThatSlidesAlongAStraightChainIsPushedByOneSegment) {
  std::vector<Vector2> chain;
  for (int i = 0; i <= 20; ++i) {
    chain.emplace_back(5.0 * i, 0.0);
  }
  Probe probe(chain);
  for (double x = 1.0; x < 99.0; x += 0.037) {
    const Vector2 place(x, 0.9);
    const Vector2 expected =
        Vector2(0.0, probe.scene().contact.stiffness * 0.1) + push_of_balls(probe, chain, place, {0.0, 1.0});
    EXPECT_NEAR((probe.force_at(place, {0.0, 1.0}) - expected).norm(), 0.0, 1e-6) << x;
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
      return probe.state().contact_stored;
    };
    const double reach = 1e-6;
    const Vector2 gradient(
        (stored_at(place + Vector2(reach, 0.0)) - stored_at(place - Vector2(reach, 0.0))) / (2 * reach),
        (stored_at(place + Vector2(0.0, reach)) - stored_at(place - Vector2(0.0, reach))) / (2 * reach));
    const Vector2 force = probe.force_at(place, outward);
    touching += force.norm() > 0.0 ? 1 : 0;
    EXPECT_NEAR((force + gradient).norm(), 0.0, 1e-4 * probe.scene().contact.stiffness) << x;
  }
  EXPECT_GT(touching, 250);
}

TEST(Contact, RemembersTheSideOfABallPressedPastTheMidLine) {
  Probe probe({{-20.0, 0.0}, {20.0, 0.0}});
  EXPECT_GT(probe.force_at({1.0, 0.5}, {0.0, 1.0}).y(), 0.0);
  const Vector2 through = probe.force_at({1.0, -0.2}, {0.0, 1.0});
  EXPECT_NEAR(through.y(), probe.scene().contact.stiffness * 1.2, 1e-6);
  probe.force_at({1.0, 5.0}, {0.0, 1.0});                        // left: forgotten
  EXPECT_LT(probe.force_at({1.0, -0.2}, {0.0, -1.0}).y(), 0.0);  // touched anew, from the other side
}

TEST(Contact, ForcesOnBallAndSegmentBalanceInForceAndMoment) {
  Probe probe({{-20.0, -3.0}, {20.0, 4.0}});
  const Vector2 axis = Vector2(40.0, 7.0).normalized();
  const Vector2 force = probe.force_at(Vector2(4.0, 1.2) + 0.8 * normal_of(axis), normal_of(axis));
  ASSERT_GT(force.norm(), 0.0);
  Vector2 sum = Vector2::Zero();
  double moment = 0.0;
  for (std::size_t i = 0; i < probe.scene().particle_count(); ++i) {
    sum += probe.state().contact_force[i];
    moment += cross(probe.state().position[i], probe.state().contact_force[i]);
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-9 * force.norm());
  EXPECT_NEAR(moment, 0.0, 1e-6 * force.norm());
}

TEST(Contact, NeighboursAtAJointDoNotTouchUntilTheWallsFold) {
  // The beam beside the joint is shorter than the walls are thick: at rest this is a joint, not a contact.
  Probe probe({{-20.0, 0.0}, {0.0, 0.0}, {0.6, 0.6}, {20.0, 0.6}});
  probe.force_at({0.0, 500.0}, {0.0, 1.0});
  for (std::size_t i = 0; i < probe.scene().particle_count(); ++i) {
    EXPECT_EQ(probe.state().contact_force[i].norm(), 0.0) << i;
  }
}

// Eq. 43 with c > 0 pulls on walls that part.
TEST(Contact, NeverPullsHoweverFastWallsPart) {
  for (const double rate : {0.0, -1e3, -1e6, 1e4}) {
    const NormalForce force = evaluate_normal_force(100.0, 0.2, 1e8, 0.01, rate);
    EXPECT_GE(force.elastic + force.viscous, 0.0);
    EXPECT_DOUBLE_EQ(force.elastic, 1.0);
  }
  EXPECT_EQ(evaluate_normal_force(100.0, 0.2, 1e8, 0.01, -1e6).viscous, -1.0);
}

}  // namespace
}  // namespace cellcrush
