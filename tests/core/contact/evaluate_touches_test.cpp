#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/touch/contact_stages.h"
#include "scenes/every_target.h"
#include "scenes/evidence.h"
#include "scenes/placed_pairs.h"

namespace cellcrush {
namespace {

using scenes::PairScene;
using scenes::PlacedPair;

constexpr double kRounding = 1e-12;

int side_now(const PlacedPair& pair) { return pair.across >= 0.0 ? 1 : -1; }

/// 203 pairs, all touching, the side of first touch as `side_of(pair)` has it, evaluated by the kernels in use.
struct Evaluated {
  std::vector<PlacedPair> pairs = scenes::draw_pairs(203);
  PairScene at{pairs};
  ContactLists lists;
  Touches touches;
  std::vector<int> released;

  template <class SideOf>
  explicit Evaluated(SideOf&& side_of) {
    at.scene.contact.stiffness = 50.0;
    at.scene.contact.damping_ratio = 0.3;
    at.scene.schedule.time_step = 0.01;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      lists.touching.ball.push_back(static_cast<int>(3 * i + 2));
      lists.touching.segment.push_back(static_cast<int>(i));
      lists.touching.reach.push_back(pairs[i].reach);
      lists.touching.side.push_back(side_of(pairs[i]));
    }
    touches.resize(pairs.size());
    evaluate_touches(at.scene, at.state, lists, touches, 0, pairs.size(), released);
  }
};

int no_side(const PlacedPair&) { return 0; }

TEST(EvaluateTouches, FindsDepthFootAndNormalOfNewPairs) {
  double worst = 0.0;
  scenes::for_every_target([&] {
    const auto [pairs, at, lists, touches, released] = Evaluated(no_side);
    std::vector<int> apart;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const PlacedPair& pair = pairs[i];
      const double foot = std::clamp(pair.ahead / pair.length, 0.0, 1.0);
      const Vector2 normal = (pair.ball() - pair.start - foot * pair.length * pair.axis).normalized();
      const double depth = pair.reach - pair.distance();
      EXPECT_NEAR(touches.depth[i], depth, kRounding) << i;
      worst = std::max(worst, std::abs(touches.depth[i] - depth));
      EXPECT_NEAR(touches.share[i], foot, kRounding) << i;
      EXPECT_NEAR((touches.normal[i] - normal).norm(), 0.0, 1e3 * kRounding) << i;
      const bool end_is_nearer = pair.to_end() < pair.to_start();
      EXPECT_EQ(touches.node[i], static_cast<int>(3 * i + (end_is_nearer ? 1 : 0))) << i;
      EXPECT_NEAR(touches.node_depth[i], pair.reach - std::min(pair.to_start(), pair.to_end()), kRounding) << i;
      EXPECT_EQ(lists.touching.side[i], depth > 0.0 ? side_now(pair) : 0) << i;
      if (depth <= 0.0) {
        apart.push_back(static_cast<int>(i));
      }
    }
    EXPECT_EQ(released, apart);
  });
  scenes::record_bound("depth error in mm", worst);
}

// v_foot - v_ball in the frame of the contact; c = 2 zeta sqrt(k m), 1/m of the ball and of the lever's two ends.
TEST(EvaluateTouches, FindsViscousForceAndSlip) {
  double worst = 0.0;
  scenes::for_every_target([&] {
    const auto [pairs, at, lists, touches, released] = Evaluated(no_side);
    const ContactLaw& law = at.scene.contact;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double s = std::clamp(pairs[i].ahead / pairs[i].length, 0.0, 1.0);
      const Vector2* v = &at.state.velocity[3 * i];
      const double* w = &at.scene.inverse_mass[3 * i];
      const Vector2 closing = v[0] + s * (v[1] - v[0]) - v[2];
      const double mass = 1.0 / (w[2] + std::pow(1.0 - s, 2) * w[0] + s * s * w[1]);
      const double damping = 2.0 * law.damping_ratio * std::sqrt(law.stiffness * mass);
      const Vector2& normal = touches.normal[i];
      const double slide = side_now(pairs[i]) * (normal.x() * closing.y() - normal.y() * closing.x());
      EXPECT_NEAR(touches.viscous[i], damping * normal.dot(closing), 1e2 * kRounding) << i;
      worst = std::max(worst, std::abs(touches.viscous[i] - damping * normal.dot(closing)));
      EXPECT_NEAR(touches.slip[i], at.scene.schedule.time_step * slide, kRounding) << i;
    }
  });
  scenes::record_bound("force error in N", worst);
}

// A ball pressed past the mid-line keeps its side and is deep; beyond an end the side is where it stands.
TEST(EvaluateTouches, KeepsTheSideOfFirstTouchOverTheInside) {
  scenes::for_every_target([&] {
    const auto [pairs, at, lists, touches, released] =
        Evaluated([](const PlacedPair& pair) { return -side_now(pair); });
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const PlacedPair& pair = pairs[i];
      if (pair.is_inside()) {
        const double through = pair.reach + std::abs(pair.across);
        EXPECT_NEAR(touches.depth[i], through < 2.0 * pair.reach ? through : 0.0, kRounding) << i;
        EXPECT_EQ(lists.touching.side[i], touches.depth[i] > 0.0 ? -side_now(pair) : 0) << i;
      } else if (pair.distance() < pair.reach) {
        EXPECT_EQ(lists.touching.side[i], side_now(pair)) << i;
      }
    }
  });
}

}  // namespace
}  // namespace cellcrush
