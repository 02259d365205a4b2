#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/state.h"
#include "scenes/beam_over_beam.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// What the short beam shows that flies onto the long one.
struct Bounce {
  double duration = 0.0;      // s
  double peak_depth = 0.0;    // mm
  double energy_ratio = 0.0;  // kinetic, after over before
};

constexpr double kSpeed = 1000.0;  // mm/s

Bounce bounce(double omega_step, double damping_ratio, double& mass, double& stiffness) {
  SceneSpec spec = scenes::beam_over_beam(kSpeed / 1e3, 0.0);
  spec.contact.damping_ratio = damping_ratio;
  auto scene = scenes::build(spec);
  mass = scene->mass[2];
  const double step = scene->schedule.time_step;
  scene->contact.stiffness = stiffness = mass * omega_step * omega_step / (step * step);
  State state = make_initial_state(*scene);
  Bounce result;
  int touching = 0;
  for (int i = 0; i < 100000 && (touching == 0 || state.contact_totals.count > 0); ++i) {
    advance_step(*scene, state, nullptr);
    touching += state.contact_totals.count > 0 ? 1 : 0;
    result.peak_depth = std::max(result.peak_depth, state.contact_totals.deepest_penetration);
    EXPECT_GE(state.contact_force[2].elastic.y() + state.contact_force[2].viscous.y(), 0.0);
  }
  advance_step(*scene, state, nullptr);
  result.duration = touching * step;
  result.energy_ratio = std::pow(state.velocity[2].y() / kSpeed, 2);
  return result;
}

TEST(PenaltyBounce, HasTheDepthDurationAndEnergyOfAMassOnASpring) {
  double mass = 0.0;
  double stiffness = 0.0;
  const Bounce soft = bounce(0.2, 0.0, mass, stiffness);
  EXPECT_NEAR(soft.peak_depth, kSpeed * std::sqrt(mass / stiffness), 0.01 * soft.peak_depth);
  EXPECT_NEAR(soft.duration, std::numbers::pi * std::sqrt(mass / stiffness), 0.2 / std::numbers::pi * soft.duration);
  scenes::record_figure("energy ratio", soft.energy_ratio, 4);
  scenes::record_figure("depth", soft.peak_depth / (kSpeed * std::sqrt(mass / stiffness)), 4);
  scenes::record_figure("duration", soft.duration / (std::numbers::pi * std::sqrt(mass / stiffness)), 2);
  EXPECT_GT(soft.energy_ratio, 0.991);
  EXPECT_LT(soft.energy_ratio, 1.009);
}

TEST(PenaltyBounce, DampingTakesEnergyAndNeverPulls) {
  double mass = 0.0;
  double stiffness = 0.0;
  const Bounce damped = bounce(0.2, 0.2, mass, stiffness);
  // exp(-2 pi zeta / sqrt(1 - zeta^2)) for a contact that may pull; a little more is kept when it may not.
  EXPECT_GT(damped.energy_ratio, 0.27);
  EXPECT_LT(damped.energy_ratio, 0.45);
}

// The default stiffness, two of the lightest particles: k = m (V / 0.16 h)^2. At 100 m/s the elements bound the step,
// at 200 m/s V dt = 0.08 h. The dampers of the contacts take up what such a bounce makes: a whole crush makes none
// (ContactSoundness).
TEST(PenaltyBounce, OfTheLightestPairAtTheChosenStepIsWithinThirteenPercent) {
  for (const double speed : {100.0, 200.0}) {
    SceneSpec spec = scenes::hexagon_specimen(4, 3);
    spec.loading.speed_m_per_s = speed;
    const auto scene = scenes::build(spec);
    const double lightest = *std::min_element(scene->mass.begin(), scene->mass.end());
    const double omega = std::sqrt(scene->contact.stiffness * 2.0 / lightest);
    const double omega_step = omega * scene->schedule.time_step;
    const double travel = 1e3 * speed * scene->schedule.time_step / scene->contact.thinnest;  // in a step
    EXPECT_EQ(scene->schedule.bound, speed == 100.0 ? StepBound::elements : StepBound::plate_travel);
    EXPECT_NEAR(omega_step, std::sqrt(2.0) * travel / 0.16, 1e-3) << speed;
    double mass = 0.0;
    double stiffness = 0.0;
    EXPECT_NEAR(bounce(omega_step, 0.0, mass, stiffness).energy_ratio, 1.0, 0.13) << speed;
  }
}

/// A short beam that lies on a held one under gravity, swinging about its resting depth by half of it.
struct Resting {
  std::shared_ptr<Scene> scene;
  State state;
  double depth = 0.0;  // mm, at rest

  explicit Resting(double omega_step) {
    scene = scenes::build(scenes::beam_over_beam(0.0, 1e4));
    const double step = scene->schedule.time_step;
    scene->contact.stiffness = scene->mass[2] * omega_step * omega_step / (step * step);
    depth = scene->mass[2] * 1e7 / scene->contact.stiffness;
    scene->position[2].y() = scene->position[3].y() = 1.0 - 0.5 * depth;
    state = make_initial_state(*scene);
  }

  /// The energy of the swing that central differences keep: velocities half a step off, places of two steps.
  [[nodiscard]] double swing_energy() const {
    const double velocity = state.velocity[2].y();
    const double now = state.position[2].y() - (1.0 - depth);
    const double before = now - scene->schedule.time_step * velocity;
    return 0.5 * scene->mass[2] * velocity * velocity + 0.5 * scene->contact.stiffness * now * before;
  }
};

TEST(PenaltyContact, RestsForAMillionStepsWithoutGainingEnergy) {
  for (const double omega_step : {0.636, 1.8}) {
    Resting resting(omega_step);
    advance_step(*resting.scene, resting.state, nullptr);
    const double before = resting.swing_energy();
    for (int i = 0; i < 1000000; ++i) {
      advance_step(*resting.scene, resting.state, nullptr);
    }
    EXPECT_NEAR(resting.swing_energy() / before, 1.0, 1e-6) << omega_step;
    scenes::record_bound("energy change", resting.swing_energy() / before - 1.0);
  }
}

}  // namespace
}  // namespace cellcrush
