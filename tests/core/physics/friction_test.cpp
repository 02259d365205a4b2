#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

constexpr double kFriction = 0.3;
constexpr double kGravity = 1000.0;  // m/s^2: short ways

constexpr int kSegments = 20;

/// A straight chain of held segments, 1 mm thick.
void add_held_chain(double from, double segment, FrameLattice& frame) {
  for (int i = 0; i <= kSegments; ++i) {
    frame.nodes.push_back({from + segment * i, 0.0, 0.0, 0.0});
    frame.supports.push_back({i, true, true, true});
    if (i > 0) frame.beams.push_back(scenes::beam(i - 1, i, 1.0, 1));
  }
}

/// A short beam that lies flat on a chain of 20 held beams, under gravity turned by `incline`.
struct Slope {
  std::shared_ptr<Scene> scene;
  State state;
  int block = 0;

  Slope(double incline, double speed_m_per_s) {
    FrameLattice frame;
    add_held_chain(-40.0, 7.0, frame);
    block = static_cast<int>(frame.nodes.size());
    frame.nodes.push_back({0.3, 1.0, 0.0, 0.0});
    frame.nodes.push_back({10.3, 1.0, 0.0, 0.0});
    frame.beams.push_back(scenes::beam(block, block + 1, 1.0, 1));
    frame.initial_velocities = {{block, speed_m_per_s, 0.0, 0.0}, {block + 1, speed_m_per_s, 0.0, 0.0}};
    frame.gravity_x_m_per_s2 = kGravity * std::sin(incline);
    frame.gravity_y_m_per_s2 = -kGravity * std::cos(incline);
    frame.self_contact = true;
    SceneSpec spec = scenes::elastic_frame(frame);
    spec.contact.friction = kFriction;
    scene = scenes::build(spec);
    state = make_initial_state(*scene);
  }

  void advance(double duration) {
    const auto steps = static_cast<int>(duration / scene->schedule.time_step);
    for (int i = 0; i < steps; ++i) {
      advance_step(*scene, state, nullptr);
    }
  }

  [[nodiscard]] double way() const { return state.position[block].x() - scene->position[block].x(); }
  [[nodiscard]] double speed() const { return state.velocity[block].x(); }
};

TEST(Friction, ASlidingBlockStopsAfterItsCoulombDistanceAndItsEnergyIsHeat) {
  const double speed = 5000.0;  // mm/s
  Slope slope(0.0, speed / 1000.0);
  const double gravity = 1000.0 * kGravity;
  const double distance = speed * speed / (2.0 * kFriction * gravity);
  ASSERT_GT(distance, 20.0);
  slope.advance(speed / (kFriction * gravity) * 1.3);
  EXPECT_NEAR(slope.speed(), 0.0, 1e-3 * speed);
  const Energies energies = evaluate_energies(*slope.scene, slope.state);
  EXPECT_LT(std::abs(energies.residual), 0.01 * slope.state.ledger.initial);
  scenes::record_bound("distance error", slope.way() / distance - 1.0, 0.02);
  scenes::record_bound("heat error", energies.friction / slope.state.ledger.initial - 1.0, 0.02);
}

TEST(Friction, ABlockSticksBelowTheAngleOfFrictionAndSlidesAboveIt) {
  const double critical = std::atan(kFriction);
  Slope below(0.95 * critical, 0.0);
  below.advance(5e-3);
  const double early = below.way();
  below.advance(5e-3);
  scenes::record_bound("creep in mm", below.way() - early, 1e-3);  // holds, without creep

  const double incline = 1.3 * critical;
  Slope above(incline, 0.0);
  const double duration = 4e-3;
  above.advance(duration);
  const double acceleration = 1000.0 * kGravity * (std::sin(incline) - kFriction * std::cos(incline));
  const double exact = 0.5 * acceleration * duration * duration;
  EXPECT_NEAR(above.way(), exact, 0.05 * above.way());
  scenes::record_bound("acceleration error in %", 100.0 * (above.way() / exact - 1.0));
}

/// The tip of an upright beam that is dragged along a straight chain of 20 held segments under a constant load, which
/// presses it `depth` mm into the chain before it sets out. Speed in mm/s.
struct Drag {
  static constexpr double kSegment = 5.0;  // mm
  std::shared_ptr<Scene> scene;
  State state;
  int tip = kSegments + 1;
  double load = 0.0;
  double departure = 0.0;  // s
  double arrival = 0.0;

  Drag(double speed, double depth) {
    FrameLattice frame;
    add_held_chain(0.0, kSegment, frame);
    frame.nodes.push_back({2.3, 1.0, 0.0, 0.0});
    frame.nodes.push_back({2.3, 11.0, 0.0, 0.0});
    frame.beams.push_back(scenes::beam(tip, tip + 1, 1.0, 1));
    const double way = kSegments * kSegment - 4.6;
    departure = 0.5 * way / speed;
    arrival = 1.5 * way / speed;
    for (const int node : {tip, tip + 1}) {
      frame.supports.push_back({node, false, false, true});
      frame.motions.push_back({node, FrameLattice::Component::x, {{0.0, 0.0}, {departure, 0.0}, {arrival, way}}});
    }
    frame.self_contact = true;
    SceneSpec spec = scenes::elastic_frame(frame);
    spec.contact.friction = kFriction;
    load = scenes::build(spec)->contact.stiffness * depth;
    spec.loads.loads = {{tip, FrameLattice::Component::y, {{0.0, 0.0}, {0.3 * departure, -load}}}};
    scene = scenes::build(spec);
    state = make_initial_state(*scene);
  }

  [[nodiscard]] double way() const { return state.position[tip].x() - scene->position[tip].x(); }
};

// Two balls and two segments touch at each of the 19 joints; the forces must not show it.
TEST(Friction, ABallSlidesAlongAStraightChainWithoutChatter) {
  for (const double depth : {0.002, 0.1}) {
    Drag drag(50e3, depth);
    double least = 1e9;
    double most = 0.0;
    double least_friction = 1e9;
    double most_friction = 0.0;
    while (drag.state.time < drag.arrival) {
      advance_step(*drag.scene, drag.state, nullptr);
      if (drag.way() > 0.1) {
        const Vector2 normal = drag.state.contact_force[drag.tip].elastic + drag.state.contact_force[drag.tip].viscous;
        const Vector2 friction = drag.state.friction_force[drag.tip] + drag.state.friction_force[drag.tip + 1];
        ASSERT_NEAR(normal.x(), 0.0, 1e-5 * drag.load);
        ASSERT_NEAR(friction.y(), 0.0, 1e-5 * drag.load);
        least = std::min(least, normal.y() / drag.load);
        most = std::max(most, normal.y() / drag.load);
        least_friction = std::min(least_friction, -friction.x() / (kFriction * drag.load));
        most_friction = std::max(most_friction, -friction.x() / (kFriction * drag.load));
      }
    }
    const Energies energies = evaluate_energies(*drag.scene, drag.state);
    const double heat = kFriction * drag.load * drag.way();
    scenes::record_bound("force error", std::max({1.0 - least, most - 1.0, 1.0 - least_friction, most_friction - 1.0}),
                         1e-3);
    scenes::record_bound("heat error", energies.friction / heat - 1.0, 2e-4);  // it sticks for the first steps
    EXPECT_LT(energies.contact_damping, 1e-4 * energies.friction);
    EXPECT_NEAR(energies.contact, drag.state.contact_totals.stored, 1e-4 * energies.friction);
    EXPECT_LT(std::abs(energies.residual), 1e-6 * energies.friction);
  }
}

TEST(Friction, PlatesHoldTheEndsOfALatticeThatSpreads) {
  const auto spread_at = [](double friction) {
    SceneSpec spec = scenes::hexagon_specimen(6, 5);
    spec.loading.direction = LoadingSpec::Direction::y;
    spec.loading.end_strain = 0.2;
    spec.loading.speed_m_per_s = 10.0;
    spec.plates.friction = friction;
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    const Sample sample = scenes::run_to_end(simulation).back();
    EXPECT_EQ(sample.energies.friction > 0.0, friction > 0.0);
    EXPECT_LT(std::abs(sample.energies.residual), 0.01 * sample.energies.external);
    double left = 1e9;
    double right = -1e9;
    for (std::size_t i = 0; i < scene->particle_count(); ++i) {
      if (scene->position[i].y() < 1.0) {  // the joints that stand on the impact plate
        left = std::min(left, simulation.state().position[i].x());
        right = std::max(right, simulation.state().position[i].x());
      }
    }
    return right - left;
  };
  EXPECT_LT(spread_at(0.5), spread_at(0.0));
}

}  // namespace
}  // namespace cellcrush
