#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// An upright beam that falls tip first, under gravity, into a groove of two held legs that share a node.
struct Groove {
  std::shared_ptr<Scene> scene;
  State state;
  int tip = 3;

  /// `opening` between the legs in degrees; the tip starts off the middle. Steps are `share` of the stable step.
  Groove(double opening, double damping_ratio, double share) {
    const double half = 0.5 * opening * std::numbers::pi / 180.0;
    constexpr double kLeg = 40.0;
    FrameLattice frame;
    frame.nodes = {{-kLeg * std::sin(half), kLeg * std::cos(half), 0.0, 0.0},
                   {0.0, 0.0, 0.0, 0.0},
                   {kLeg * std::sin(half), kLeg * std::cos(half), 0.0, 0.0},
                   {0.36, 12.0, 0.0, 0.0},
                   {0.36, 32.0, 0.0, 0.0}};
    frame.beams = {scenes::beam(0, 1, 1.0, 1), scenes::beam(1, 2, 1.0, 1), scenes::beam(3, 4, 1.0, 1)};
    frame.supports = {{0, true, true, true},
                      {1, true, true, true},
                      {2, true, true, true},
                      {3, false, false, true},
                      {4, false, false, true}};
    frame.initial_velocities = {{3, 0.0, -10.0, 0.0}, {4, 0.0, -10.0, 0.0}};
    frame.gravity_y_m_per_s2 = -1e4;
    frame.self_contact = true;
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

// The tip bounces from leg to leg and again and again touches both.
TEST(Groove, LosslessContactTakesAndMakesNoEnergyAndNeverPushesTwice) {
  for (const double opening : {90.0, 120.0, 160.0}) {
    Groove groove(opening, 0.0, 0.1);
    EXPECT_LT(groove.advance(20e-3), 1.0 + 1e-9) << opening;
    const Energies energies = evaluate_energies(*groove.scene, groove.state);
    EXPECT_NEAR(energies.contact, groove.state.contact_totals.stored, 5e-3 * groove.state.ledger.initial) << opening;
    EXPECT_LT(std::abs(energies.residual), 1e-3 * groove.state.ledger.initial) << opening;
    scenes::record_bound("energy error",
                         (energies.contact - groove.state.contact_totals.stored) / groove.state.ledger.initial);
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
