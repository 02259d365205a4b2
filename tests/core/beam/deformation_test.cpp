#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/direction.h"
#include "scenes/evidence.h"
#include "scenes/kernels.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::turn_between;

// The arc cosine of the paper's Eq. 9 gives 0 below 2e-8 rad and never a sign.
TEST(Turn, TinyIncrementsOfBothSignsSurvive) {
  double worst = 0.0;
  for (const double angle : {1e-9, -1e-9, 3e-12, -3e-12}) {
    const Vector2 to = Vector2(1.0, angle).normalized();
    const double error = std::abs(turn_between({1.0, 0.0}, to) / angle - 1.0);
    worst = std::max(worst, error);
    EXPECT_LT(error, 1e-6) << angle;
    EXPECT_EQ(std::acos(Vector2(1.0, 0.0).dot(to)), 0.0);
  }
  scenes::record_bound("relative error", worst);
}

TEST(Turn, IsExactFromTheSeriesToHalfATurn) {
  for (double angle = -3.14; angle <= 3.14; angle += 0.0031) {
    EXPECT_NEAR(turn_between(direction(0.3), direction(0.3 + angle)), angle, 1e-15 + 2e-16 * std::abs(angle));
  }
  EXPECT_NEAR(turn_between(direction(0.0), direction(0.0199999)), 0.0199999, 1e-17);
}

TEST(ReverseMotion, TakesOutRigidMotionAndLeavesStretchAndTurns) {
  const Vector2 axis = direction(0.7);
  const double rigid_turn = 0.01;
  const scenes::ElementDeformation deformation =
      scenes::reverse_motion(2.02 * direction(0.7 + rigid_turn), axis, 2.0, rigid_turn + 0.003, rigid_turn - 0.001);
  EXPECT_NEAR(deformation.stretch, 0.02, 1e-15);
  EXPECT_NEAR(deformation.rotation_start, 0.003, 1e-15);
  EXPECT_NEAR(deformation.rotation_end, -0.001, 1e-15);
}

}  // namespace
}  // namespace cellcrush
