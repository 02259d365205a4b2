#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/state.h"
#include "contact/touch/force_laws.h"
#include "scene/time_step.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

// Failure modes of contact between two walls: each without its guard, and with it.

constexpr double kReach = 1.0;  // mm, of two beams

/// A beam that flies onto another, and where it is after it has had the time to fly back.
struct Flight {
  std::shared_ptr<Scene> scene;
  State state;

  /// A free ball at this speed would sink in by `depth` mm; the step is that in which the beam flies `advance` mm.
  Flight(double speed_m_per_s, double depth, double advance) {
    scene = scenes::build(scenes::beam_over_beam(speed_m_per_s, 0.0));
    const double speed = 1e3 * speed_m_per_s;
    scene->contact.stiffness = scene->mass[2] * std::pow(speed / depth, 2);
    scene->schedule.time_step = advance / speed;
    state = make_initial_state(*scene);
  }

  /// Height of the flown beam over the other, mm, after the way of 20 mm.
  double height(bool remembers_sides) {
    const double speed = std::abs(scene->initial_velocity[2].y());
    while (state.time < 20.0 / speed) {
      if (!remembers_sides) {
        std::fill(state.contacts.front().touching.side.begin(), state.contacts.front().touching.side.end(), 0);
      }
      advance_step(*scene, state, nullptr);
    }
    return state.position[2].y();
  }
};

// 1/2 m V^2 > 1/2 k g^2: the spring is used up before the beam stands.
TEST(Tunnelling, AContactTooSoftForTheSpeedLetsAWallThrough) {
  EXPECT_LT(Flight(100.0, 3.0 * kReach, 0.01).height(true), -5.0);
  EXPECT_GT(Flight(100.0, 0.16 * kReach, 0.01).height(true), 5.0);  // as stiff as that of lattices
}

// V dt > R + h/2: the beam is above in one step and below in the next.
TEST(Tunnelling, AStepTooLongForTheSpeedHopsOverAWall) {
  Flight hop(100.0, 0.16 * kReach, 2.1 * kReach);
  EXPECT_LT(hop.height(true), -5.0);
  EXPECT_EQ(hop.state.contact_totals.deepest_penetration, 0.0) << "no contact was seen, so nothing can tell";
  EXPECT_GT(Flight(100.0, 0.16 * kReach, kTravelPerStep * kReach).height(true), 5.0);  // the chosen step of lattices
}

// Between plates the chosen step cannot hop: the plate moves by kTravelPerStep of the thinnest wall.
TEST(Tunnelling, TheChosenStepOfALatticeFollowsTheSpeed) {
  for (const double speed : {100.0, 200.0, 400.0, 1000.0}) {
    SceneSpec spec = scenes::hexagon_specimen(4, 3);
    spec.loading.speed_m_per_s = speed;
    const auto scene = scenes::build(spec);
    EXPECT_LE(1e3 * speed * scene->schedule.time_step, kTravelPerStep * 0.3464 * (1.0 + 1e-9)) << speed;
  }
}

// Eq. 42 pushes a ball on once it is past the mid-line. The side of first touch brings it back.
TEST(SignFlip, ABallPressedPastTheMidLineIsPulledThroughUnlessItsSideIsRemembered) {
  Flight forgetful(100.0, 1.5 * kReach, 0.01);
  EXPECT_LT(forgetful.height(false), -5.0);
  EXPECT_GT(std::abs(forgetful.state.velocity[2].y()), 1e3 * 100.0 * 0.5);
  Flight mindful(100.0, 1.5 * kReach, 0.01);
  EXPECT_GT(mindful.height(true), 5.0);
  EXPECT_NEAR(mindful.state.velocity[2].y(), 1e3 * 100.0, 1e3);
}

// Walls that lie in each other from the start are a wound spring that no work was done on. Their reach is the distance
// at which they stand (StartOverlaps.*).
TEST(StartOverlap, WallsThatBeginInEachOtherFlyApartOnEnergyThatNobodyPut) {
  const auto scene = scenes::build(scenes::beam_over_beam(0.0, 0.0));
  scene->position[2].y() = scene->position[3].y() = 0.5 * kReach;
  Simulation simulation(scene);
  simulation.advance(50);
  EXPECT_GT(simulation.state().velocity[2].y(), 1e3);
  EXPECT_EQ(simulation.take_sample().energies.external, 0.0);
}

// Beyond omega dt = 2 a resting contact throws what lies on it; up to there it keeps its energy for a million steps
// (PenaltyContact.RestsForAMillionStepsWithoutGainingEnergy).
TEST(RestingContact, ThrowsWhatLiesOnItWhenTooStiffForTheStep) {
  const auto fastest_at = [](double omega_step) {
    const auto scene = scenes::build(scenes::beam_over_beam(0.0, 1e4));
    const double step = scene->schedule.time_step;
    scene->contact.stiffness = scene->mass[2] * omega_step * omega_step / (step * step);
    const double depth = scene->mass[2] * 1e7 / scene->contact.stiffness;
    scene->position[2].y() = scene->position[3].y() = kReach - 0.9 * depth;
    State state = make_initial_state(*scene);
    double fastest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      advance_step(*scene, state, nullptr);
      fastest = std::max(fastest, std::abs(state.velocity[2].y()));
    }
    return fastest / (1e7 * step);  // over the speed of one step's fall
  };
  EXPECT_LT(fastest_at(1.8), 1.0);
  EXPECT_GT(fastest_at(2.05), 10.0);
}

// Eq. 43 with c > 0 pulls on walls that part.
TEST(Adhesion, AViscousContactPullsOnWallsThatPartUnlessItIsClamped) {
  constexpr double kStiffness = 100.0;
  constexpr double kDampingRatio = 0.2;
  constexpr double kInverseMass = 1e8;
  constexpr double kDepth = 0.01;
  const double damping = 2.0 * kDampingRatio * std::sqrt(kStiffness / kInverseMass);
  for (const double rate : {-1e4, -1e5, -1e6}) {
    EXPECT_LT(kStiffness * kDepth + damping * rate, 0.0);  // Eq. 43 as it stands
    const NormalForce force = evaluate_normal_force(kStiffness, kDampingRatio, kInverseMass, kDepth, rate);
    EXPECT_EQ(force.elastic + force.viscous, 0.0) << rate;
  }
}

// With the gap R + h/2 for every pair, walls of many short elements touch themselves round every joint before loading
// and the specimen bursts. Pairs joined by a short way touch at 0.4 of it.
TEST(ThickNeighbours, TouchAtEveryJointBeforeLoadingWithTheLiteralGap) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  scenes::cells_of(spec).wall_thickness_mm = 0.8;
  spec.elements_per_wall = 8;
  const auto scene = scenes::build(spec);
  const State sound = make_initial_state(*scene);
  EXPECT_EQ(sound.contact_totals.count, 0);
  EXPECT_EQ(sound.contact_totals.stored, 0.0);
  scene->limited_reaches = {};
  const State literal = make_initial_state(*scene);
  EXPECT_GT(literal.contact_totals.count, 300);
  EXPECT_GT(literal.contact_totals.deepest_penetration, 0.3);
}

// Friction as a function of the sliding speed, beside friction that remembers how far its spring is stretched.

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
