#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <variant>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scene/time_step.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/near_pairs.h"

// A gas of short bars in a closed box, all free: what collisions must keep. Blind to: which way a collision sends a
// bar, as long as it keeps momentum and energy (PenaltyBounce, BarImpact).
namespace cellcrush::gas {
namespace {

constexpr double kSide = 60.0;  // mm, of the box
constexpr int kBars = 9;
constexpr double kSpeed = 20e3;  // mm/s

/// A free box of four beams and nine bars within, which fly and spin at random. Lossless contact, elastic; a step of 0
/// is chosen by the solver.
SceneSpec gas(double step) {
  std::mt19937_64 generator(7);
  const auto draw = [&] { return 2.0 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1.0; };
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kSide, 0.0, 0.0, 0.0}, {kSide, kSide, 0.0, 0.0}, {0.0, kSide, 0.0, 0.0}};
  for (int i = 0; i < 4; ++i) frame.beams.push_back(scenes::beam(i, (i + 1) % 4, 2.0, 2));
  for (int i = 0; i < kBars; ++i) {
    const int row = i / 3;
    const Vector2 centre(15.0 + 15.0 * (i % 3), 15.0 + 15.0 * row);
    const double angle = 3.0 * draw();
    const Vector2 half = 4.0 * Vector2(std::cos(angle), std::sin(angle));
    const Vector2 velocity = kSpeed * Vector2(draw(), draw());
    const double spin = 2000.0 * draw();
    const int node = static_cast<int>(frame.nodes.size());
    for (const double side : {-1.0, 1.0}) {
      const Vector2 place = centre + side * half;
      const Vector2 speed = velocity + side * spin * Vector2(-half.y(), half.x());
      frame.initial_velocities.push_back(
          {static_cast<int>(frame.nodes.size()), 1e-3 * speed.x(), 1e-3 * speed.y(), spin});
      frame.nodes.push_back({place.x(), place.y(), 0.0, 0.0});
    }
    frame.beams.push_back(scenes::beam(node, node + 1, 1.0, 1));
  }
  frame.self_contact = true;
  frame.end_time_s = 0.02;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  spec.contact.damping_ratio = 0.0;
  spec.numerics.time_step_s = step;
  return spec;
}

/// What 140 touches have changed.
struct Changes {
  double linear = 0.0;    // of the momentum, over the sum of m |v|
  double angular = 0.0;   // over the sum of |x m v|
  double energy = 0.0;    // greatest of kinetic, elastic and stored contact energy, over that at the start
  double residual = 0.0;  // greatest of the ledger, over the same
};

/// At a share of the chosen step.
Changes fly(double share) {
  const double step = scenes::build(gas(0.0))->schedule.time_step;
  const auto scene = scenes::build(gas(share * step));
  Simulation simulation(scene);
  const scenes::Momentum before = scenes::momentum_of(*scene, simulation.state());
  double speeds = 0.0;   // sum of m |v|
  double moments = 0.0;  // sum of |x m v|
  for (std::size_t i = 0; i < scene->particle_count(); ++i) {
    speeds += scene->mass[i] * simulation.state().velocity[i].norm();
    moments += scene->mass[i] * simulation.state().velocity[i].norm() * simulation.state().position[i].norm();
  }
  Changes changes;
  std::int64_t touches = 0;
  std::int64_t touching = 0;
  scenes::follow(simulation, [&](const State& state) {
    const ContactTotals& contacts = state.contact_totals;
    touches += std::max<std::int64_t>(0, contacts.count - touching);
    touching = contacts.count;
    if (state.step % 100 != 0) return;
    const Energies energies = evaluate_energies(*scene, state);
    const double sum = energies.kinetic + energies.elastic + contacts.stored;
    changes.energy = std::max(changes.energy, std::abs(sum / energies.initial - 1.0));
    changes.residual = std::max(changes.residual, std::abs(energies.residual / energies.initial));
  });
  const scenes::Momentum after = scenes::momentum_of(*scene, simulation.state());
  changes.linear = (after.linear - before.linear).norm() / speeds;
  changes.angular = (after.angular - before.angular) / moments;
  EXPECT_EQ(simulation.step(), scene->schedule.step_count) << simulation.status().message;
  EXPECT_GT(touches, 100);
  EXPECT_LT(simulation.state().contact_totals.deepest_penetration, 0.35);
  return changes;
}

TEST(Gas, OfBarsInAFreeBoxKeepsItsMomentaAndItsEnergy) {
  // A penalty contact begins and ends between two steps, so that the step decides how well a bounce keeps its energy.
  const Changes chosen = fly(1.0);
  const Changes fine = fly(0.1);
  for (const Changes& changes : {chosen, fine}) {
    scenes::record_bound("momentum", changes.linear, 1e-12);
    scenes::record_bound("angular momentum", changes.angular, 1e-12);
  }
  scenes::record_bound("energy at the chosen step", chosen.energy, 0.03);
  scenes::record_bound("energy at a tenth of it", fine.energy, 5e-4);
  scenes::record_bound("residual at the chosen step", chosen.residual, 5e-4);
  scenes::record_bound("residual at a tenth of it", fine.residual, 5e-6);
}

}  // namespace
}  // namespace cellcrush::gas

// Thin bars that fly at each other across: what the stiffness of contacts, the step and the guard of frames must bear.
// Blind to: masses that differ much (a heavier bar sinks in deeper), and lattices between plates.
namespace cellcrush::crossing_bars {
namespace {

constexpr double kThickness = 0.1;  // mm
constexpr double kLength = 10.0;
constexpr int kElements = 10;
constexpr double kGap = 0.3;
constexpr double kSpeed = 400.0;  // m/s

/// A free bar along x, and one above it at an angle in degrees that flies down at it with a speed in m/s. Its lower end
/// would strike at `place` mm from the middle of the first.
SceneSpec bars(double angle, double place, double speed) {
  const Vector2 along = scenes::direction(angle * std::numbers::pi / 180.0);
  const Vector2 low(place, kThickness + kGap);
  const Vector2 high = low + kLength * along;
  FrameLattice frame = scenes::touching_beams({{-0.5 * kLength, 0.0}, {0.5 * kLength, 0.0}, low, high},
                                              {{0, 1}, {2, 3}}, kThickness, kElements);
  if (speed > 0.0) frame.initial_velocities = {{2, 0.0, -speed, 0.0}, {3, 0.0, -speed, 0.0}};
  frame.end_time_s = 20.0 * kGap / (1e3 * kSpeed);
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  spec.contact.damping_ratio = 0.0;
  return spec;
}

/// What a flight shows.
struct Flight {
  RunStatus status;
  bool crossed = false;
  double momentum = 0.0;     // change, over the sum of m |v|
  double energy = 0.0;       // greatest change of kinetic, elastic and stored energy, over that at the start
  double residual = 0.0;     // greatest of the ledger, over the same
  double penetration = 0.0;  // deepest, over the thickness
  double transfer = 0.0;     // momentum that the first bar has taken from the second, over that of the second
};

enum class Guard { on, off };

Flight fly(const SceneSpec& spec, Guard guard = Guard::on) {
  const auto scene = scenes::build(spec);
  if (guard == Guard::off) scene->contact.most_travel = 0.0;
  Simulation simulation(scene);
  const auto momentum_of = [&](int first_joint, int first_inner) {
    Vector2 sum = scene->mass[first_joint] * simulation.state().velocity[first_joint] +
                  scene->mass[first_joint + 1] * simulation.state().velocity[first_joint + 1];
    for (int j = 0; j + 1 < kElements; ++j) {
      const int i = first_inner + 2 * j;
      sum += scene->mass[i] * simulation.state().velocity[i];
    }
    return sum;
  };
  const auto both = [&] { return std::pair(momentum_of(0, 4), momentum_of(2, 5)); };
  const auto [first, second] = both();
  Flight flight;
  const auto note = [&](const Sample&) {
    flight.crossed = flight.crossed || !scenes::find_crossings(*scene, simulation.state()).empty();
    const Energies energies = evaluate_energies(*scene, simulation.state());
    const double sum = energies.kinetic + energies.elastic + simulation.state().contact_totals.stored;
    flight.energy = std::max(flight.energy, std::abs(sum / energies.initial - 1.0));
    flight.residual = std::max(flight.residual, std::abs(energies.residual / energies.initial));
  };
  scenes::watch(simulation, note, 5);
  flight.status = simulation.status();
  const auto [first_after, second_after] = both();
  flight.momentum = (first_after + second_after - first - second).norm() / second.norm();
  flight.transfer = (first_after - first).norm() / second.norm();
  flight.penetration = simulation.state().contact_totals.deepest_penetration;
  return flight;
}

constexpr double kAngles[] = {5.0, 20.0, 45.0, 90.0};
constexpr double kPlace = -4.3;

/// Two bars that meet at kSpeed, at a step in which they approach by a share of their thickness.
SceneSpec bars_at_step(double angle, double share) {
  SceneSpec spec = bars(angle, kPlace, kSpeed);
  spec.numerics.time_step_s = share * kThickness / (1e3 * kSpeed);
  return spec;
}

/// The upper bar is pushed down at its far end until it has the speed, and then strikes the lower one.
SceneSpec pushed_bar(double contacts_for) {
  SceneSpec spec = bars(90.0, kPlace, 0.0);
  auto& frame = std::get<FrameWalls>(spec.lattice);
  constexpr double kTime = 2e-5;  // s
  constexpr double kMass = 1e-12 * scenes::kDensity * kLength * kThickness;
  for (const int node : {2, 3}) frame.nodes[node].y_mm += 4.5;
  spec.loads.loads = {
      {3,
       FrameLattice::Component::y,
       {{0.0, -1e3 * kSpeed * kMass / kTime}, {kTime, -1e3 * kSpeed * kMass / kTime}, {1.001 * kTime, 0.0}}}};
  spec.loading.end_time_s = 2.0 * kTime;
  spec.contact.impact_speed_m_per_s = contacts_for;
  return spec;
}

TEST(CrossingBars, BounceOffEachOtherAt400MetresASecond) {
  for (const double angle : kAngles) {
    const Flight flight = fly(bars(angle, kPlace, kSpeed));
    EXPECT_EQ(flight.status.kind, RunStatus::Kind::finished) << angle << ": " << flight.status.message;
    EXPECT_FALSE(flight.crossed) << angle;
    EXPECT_GT(flight.transfer, 0.15) << angle;
    scenes::record_bound("penetration over thickness", flight.penetration, 0.25);
    scenes::record_bound("momentum", flight.momentum, 1e-13);
    scenes::record_bound("energy", flight.energy, 0.01);
    scenes::record_bound("residual", flight.residual, 2e-3);
  }
}

TEST(CrossingBars, StiffnessAndStepFollowTheSpeedOfApproach) {
  const auto fast = scenes::build(bars(45.0, kPlace, kSpeed));
  const double lightest = *std::ranges::min_element(fast->mass);
  const double rate = 1e3 * kSpeed / (0.16 * kThickness);  // V sqrt(m / k) = 0.16 h
  EXPECT_NEAR(fast->contact.stiffness, lightest * rate * rate, 1e-9 * fast->contact.stiffness);
  EXPECT_NEAR(fast->schedule.time_step, kTravelPerStep * kThickness / (1e3 * kSpeed), 1e-12 * fast->schedule.time_step);
  EXPECT_EQ(fast->schedule.bound, StepBound::approach);
  SceneSpec both = bars(45.0, kPlace, 0.5 * kSpeed);  // the same speed of approach, shared
  for (const int node : {0, 1}) both.loads.initial_velocities.push_back({node, 0.0, 0.5 * kSpeed, 0.0});
  EXPECT_DOUBLE_EQ(scenes::build(both)->contact.stiffness, fast->contact.stiffness);
  const auto at_rest = scenes::build(bars(45.0, kPlace, 0.0));
  EXPECT_EQ(at_rest->schedule.bound, StepBound::elements);
  EXPECT_LT(at_rest->contact.stiffness, 0.5 * fast->contact.stiffness);
}

// What the guard lets pass is sound: the fraction at which bars go through each other is half as large again.
TEST(ContactGuard, LetsPassNoStepAtWhichBarsGoThroughEachOther) {
  int finished = 0;
  int lost = 0;
  for (const double angle : kAngles) {
    for (double share = 0.05; share < 0.75; share += 0.05) {
      const Flight flight = fly(bars_at_step(angle, share));
      const bool has_finished = flight.status.kind == RunStatus::Kind::finished;
      EXPECT_TRUE(has_finished || flight.status.kind == RunStatus::Kind::contact_lost) << flight.status.message;
      EXPECT_FALSE(has_finished && flight.crossed) << angle << " degrees, " << share;
      EXPECT_TRUE(!has_finished || flight.energy < 0.02) << angle << " degrees, " << share << ": " << flight.energy;
      EXPECT_TRUE(has_finished || share > 0.18) << angle << " degrees, " << share << ": " << flight.status.message;
      EXPECT_TRUE(!has_finished || share < 0.45) << angle << " degrees, " << share;
      (has_finished ? finished : lost) += 1;
    }
  }
  EXPECT_GT(finished, 10);
  EXPECT_GT(lost, 15);
}

// The lightest particle, free, sinks in by V dt / 0.6 at a given step.
TEST(ContactGuard, EndsRunsWellBeforeBarsGoThroughEachOther) {
  double least = 0.78;  // longer steps are unstable
  for (const double angle : kAngles) {
    for (double share = 0.3; share < least; share += 0.05) {
      if (fly(bars_at_step(angle, share), Guard::off).crossed) least = share;
    }
  }
  scenes::record_figure("least travel a step over the thickness", least, 2);
  EXPECT_GT(least, 0.45);
  EXPECT_LT(least, 0.75);
}

TEST(ContactGuard, NamesPlaceSpeedAndRemedy) {
  const RunStatus status = fly(bars_at_step(90.0, 0.7)).status;
  EXPECT_EQ(status.kind, RunStatus::Kind::contact_lost);
  EXPECT_NE(status.message.find("particle "), std::string::npos) << status.message;
  EXPECT_NE(status.message.find("at step "), std::string::npos) << status.message;
  EXPECT_NE(status.message.find("400 m/s"), std::string::npos) << status.message;
  EXPECT_NE(status.remedy.find("numerics.time_step_s"), std::string::npos) << status.remedy;
  EXPECT_NE(status.remedy.find("contact.impact_speed_m_per_s as 400"), std::string::npos) << status.remedy;
}

TEST(ContactGuard, LoadsThatMakeBarsFastNeedTheSpeedInTheCase) {
  const Flight unknown = fly(pushed_bar(0.0));
  EXPECT_EQ(unknown.status.kind, RunStatus::Kind::contact_lost) << unknown.status.message;
  EXPECT_EQ(unknown.status.remedy.find("numerics.time_step_s"), std::string::npos) << unknown.status.remedy;
  const Flight known = fly(pushed_bar(1.5 * kSpeed));
  EXPECT_EQ(known.status.kind, RunStatus::Kind::finished) << known.status.message;
  EXPECT_FALSE(known.crossed);
}

// The bar's end is 2000 times as heavy as the particles for which contacts are made.
TEST(ContactGuard, SeesAHeavyBarSinkIn) {
  SceneSpec spec = bars(90.0, kPlace, 40.0);
  auto& frame = std::get<FrameWalls>(spec.lattice);
  frame.nodes[2].attached_mass_g = 1e6 * 2000.0 * 1e-12 * scenes::kDensity * kLength * kThickness / kElements;
  frame.supports = {{0, true, true, true}, {1, true, true, true}};
  frame.beams[0].elements = 1;
  spec.loading.end_time_s = 20.0 * kGap / 40e3;
  Simulation simulation(scenes::build(spec));
  scenes::watch(
      simulation, [](const Sample&) {}, 20);
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::contact_lost) << simulation.status().message;
  EXPECT_NE(simulation.status().message.find("sunk"), std::string::npos) << simulation.status().message;
}

}  // namespace
}  // namespace cellcrush::crossing_bars
