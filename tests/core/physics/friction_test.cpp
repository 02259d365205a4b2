#include <gtest/gtest.h>

#include <cmath>

#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

constexpr double kFriction = 0.3;
constexpr double kGravity = 1000.0;  // m/s^2: short ways

/// A short beam that lies flat on a chain of 20 held beams, under gravity turned by `incline`.
struct Slope {
  std::shared_ptr<Scene> scene;
  State state;
  int block = 0;

  Slope(double incline, double speed_m_per_s) {
    FrameLattice frame;
    for (int i = 0; i <= 20; ++i) {
      frame.nodes.push_back({7.0 * i - 40.0, 0.0, 0.0, 0.0});
      frame.supports.push_back({i, true, true, true});
    }
    for (int i = 0; i < 20; ++i) {
      frame.beams.push_back(scenes::beam(i, i + 1, 1.0, 1));
    }
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
  EXPECT_NEAR(slope.way(), distance, 0.02 * distance);
  EXPECT_NEAR(slope.speed(), 0.0, 1e-3 * speed);
  const Energies energies = evaluate_energies(*slope.scene, slope.state);
  EXPECT_NEAR(energies.friction, slope.state.ledger.initial, 0.02 * slope.state.ledger.initial);
  EXPECT_LT(std::abs(energies.residual), 0.01 * slope.state.ledger.initial);
}

TEST(Friction, ABlockSticksBelowTheAngleOfFrictionAndSlidesAboveIt) {
  const double critical = std::atan(kFriction);
  Slope below(0.95 * critical, 0.0);
  below.advance(5e-3);
  const double early = below.way();
  below.advance(5e-3);
  EXPECT_LT(std::abs(below.way() - early), 1e-3);  // holds, without creep

  const double incline = 1.3 * critical;
  Slope above(incline, 0.0);
  const double duration = 4e-3;
  above.advance(duration);
  const double acceleration = 1000.0 * kGravity * (std::sin(incline) - kFriction * std::cos(incline));
  EXPECT_NEAR(above.way(), 0.5 * acceleration * duration * duration, 0.05 * above.way());
}

TEST(Friction, PlatesHoldTheEndsOfALatticeThatSpreads) {
  const auto spread_at = [](double friction) {
    SceneSpec spec = scenes::hexagon_block(6, 5);
    spec.loading.direction = LoadingSpec::Direction::y;
    spec.loading.end_strain = 0.2;
    spec.loading.speed_m_per_s = 10.0;
    spec.plates.friction = friction;
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    simulation.advance(scene->schedule.step_count);
    const Sample sample = simulation.take_sample();
    EXPECT_EQ(sample.energy_friction > 0.0, friction > 0.0);
    EXPECT_LT(std::abs(sample.energy_residual), 0.01 * sample.work_external);
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
