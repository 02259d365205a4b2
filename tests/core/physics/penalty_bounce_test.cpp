// Contact under penalty in motion: a bounce, a rest of a million steps, a ball in a groove.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/state.h"
#include "energy/ledger.h"
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

// The default stiffness, two of the lightest particles: k = m (V / 0.16 h)^2, and V dt = 0.09 h. The dampers
// of the contacts take up what such a bounce makes: a whole crush makes none (ContactSoundness).
TEST(PenaltyBounce, OfTheLightestPairAtTheChosenStepIsWithinThirteenPercent) {
  for (const double speed : {100.0, 200.0}) {
    SceneSpec spec = scenes::hexagon_specimen(4, 3);
    spec.loading.speed_m_per_s = speed;
    const auto scene = scenes::build(spec);
    const double lightest = *std::min_element(scene->mass.begin(), scene->mass.end());
    const double omega = std::sqrt(scene->contact.stiffness * 2.0 / lightest);
    const double omega_step = omega * scene->schedule.time_step;
    const double travel = 1e3 * speed * scene->schedule.time_step / scene->contact.thinnest;  // in a step
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
    scenes::record_bound("energy change", resting.swing_energy() / before - 1.0, 1e-6);
  }
}

/// An upright beam that falls tip first, under gravity, into a groove of two held legs that share a node.
struct Groove {
  std::shared_ptr<Scene> scene;
  State state;
  int tip = 3;

  /// `opening` between the legs in degrees; the tip starts off the middle. Steps are `share` of the stable step.
  Groove(double opening, double damping_ratio, double share) {
    const double half = 0.5 * opening * std::numbers::pi / 180.0;
    constexpr double kLeg = 40.0;
    FrameLattice frame = scenes::touching_beams({{-kLeg * std::sin(half), kLeg * std::cos(half)},
                                                 {0.0, 0.0},
                                                 {kLeg * std::sin(half), kLeg * std::cos(half)},
                                                 {0.36, 12.0},
                                                 {0.36, 32.0}},
                                                {{0, 1}, {1, 2}, {3, 4}}, 1.0, 1);
    frame.supports = {{0, true, true, true},
                      {1, true, true, true},
                      {2, true, true, true},
                      {3, false, false, true},
                      {4, false, false, true}};
    frame.initial_velocities = {{3, 0.0, -10.0, 0.0}, {4, 0.0, -10.0, 0.0}};
    frame.gravity_y_m_per_s2 = -1e4;
    SceneSpec spec = scenes::elastic_frame(frame);
    spec.contact.damping_ratio = damping_ratio;
    spec.contact.stiffness_factor = 0.25;
    scene = scenes::build(spec);
    scene->schedule.time_step = share * scene->stable_step;
    state = make_initial_state(*scene);
  }

  /// Steps on; returns the greatest normal force on the tip over k times the deepest touch.
  double advance(double duration) {
    double most = 0.0;
    while (state.time < duration) {
      advance_step(*scene, state, nullptr);
      most = std::max(most, state.contact_force[tip].elastic.norm());
    }
    return most / (scene->contact.stiffness * state.contact_totals.deepest_penetration);
  }
};

// The tip bounces from leg to leg and again and again touches both. Where the other leg comes nearer within a step, the
// push turns a step late: an error of first order in the step, of either sign, up to 4 % in one such event at a tenth
// of the stable step.
TEST(Groove, LosslessContactTakesAndMakesNoEnergyAndNeverPushesTwice) {
  for (const double opening : {90.0, 120.0, 160.0}) {
    Groove groove(opening, 0.0, 0.025);
    EXPECT_LT(groove.advance(12e-3), 1.0 + 1e-9) << opening;
    const Energies energies = evaluate_energies(*groove.scene, groove.state);
    EXPECT_LT(std::abs(energies.residual), 1e-3 * groove.state.ledger.initial) << opening;
    scenes::record_bound("energy error",
                         (energies.contact - groove.state.contact_totals.stored) / groove.state.ledger.initial, 1e-3);
  }
}

// Neither leg alone can bear the tip at the bottom: both do, in turn, and their turns leave it a hum of 1e-4 mm.
TEST(Groove, ADampedBallComesToRestAtTheBottom) {
  for (const double opening : {60.0, 90.0, 120.0}) {
    Groove groove(opening, 0.2, 0.9);
    EXPECT_LT(groove.advance(30e-3), 1.0 + 1e-9) << opening;
    const double bottom = 1.0 / std::sin(0.5 * opening * std::numbers::pi / 180.0);
    EXPECT_NEAR(groove.state.position[groove.tip].x(), 0.0, 0.01) << opening;
    EXPECT_NEAR(groove.state.position[groove.tip].y(), bottom, 0.01) << opening;
    EXPECT_LT(evaluate_energies(*groove.scene, groove.state).kinetic, 0.02 * groove.state.ledger.initial) << opening;
  }
}

}  // namespace
}  // namespace cellcrush
