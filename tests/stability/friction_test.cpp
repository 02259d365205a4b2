// Friction as a function of the sliding speed, beside friction that remembers how far its spring is stretched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/touch/force_laws.h"

namespace cellcrush {
namespace {

constexpr double kMass = 1e-8;    // tonne
constexpr double kGravity = 1e6;  // mm/s^2
constexpr double kFriction = 0.3;
constexpr double kIncline = 0.2;                           // rad: below the angle of friction
constexpr double kDuration = 2e-3;                         // s
constexpr double kStiffness = 1e-8 / (1e-6 * 1e-6) * 0.1;  // N/mm

struct Slide {
  double reversals = 0.0;  ///< of the friction force, a step
  double swing = 0.0;      ///< mm/s, of the speed in the second half
};

/// A block on an incline that is to stand, by central differences; `friction` gives the force on it from its velocity
/// and the slip of the step.
template <class Friction>
Slide stand(double step, Friction&& friction) {
  const double normal = kMass * kGravity * std::cos(kIncline);
  const int steps = static_cast<int>(kDuration / step);
  double velocity = 0.0;
  double force = 0.0;
  Slide slide;
  for (int i = 0; i < steps; ++i) {
    velocity += step * (kGravity * std::sin(kIncline) + force / kMass);
    const double before = force;
    force = friction(velocity, step * velocity, force, kFriction * normal);
    slide.reversals += before * force < 0.0 ? 1.0 / steps : 0.0;
    slide.swing = std::max(slide.swing, 2 * i > steps ? std::abs(velocity) : 0.0);
  }
  return slide;
}

// Coulomb's law as it stands, -mu N sign(v), turns round in most steps and swings by what one step gives: a stick-slip
// that the step makes. Friction.ABlockSticksBelowTheAngleOfFriction is the whole solver on such an incline.
TEST(StickSlip, OfASignOfTheSpeedIsLockedToTheStepAndOfASpringIsNot) {
  const auto sign = [](double velocity, double, double, double bound) {
    return velocity > 0.0 ? -bound : velocity < 0.0 ? bound : 0.0;
  };
  const auto spring = [](double, double slip, double before, double bound) {
    return evaluate_friction(before, kStiffness, slip, bound);
  };
  const Slide coarse = stand(1e-6, sign);
  const Slide fine = stand(0.5e-6, sign);
  EXPECT_GT(coarse.reversals, 0.3);
  EXPECT_GT(fine.reversals, 0.3);
  EXPECT_NEAR(fine.swing / coarse.swing, 0.5, 0.1);
  for (const double step : {1e-6, 0.5e-6}) {
    const Slide held = stand(step, spring);
    EXPECT_EQ(held.reversals, 0.0) << step;  // it swings about its hold, lossless, and never turns round
    EXPECT_LT(held.swing, kGravity * std::sin(kIncline) * std::sqrt(kMass / kStiffness) * 1.05) << step;
  }
}

}  // namespace
}  // namespace cellcrush
