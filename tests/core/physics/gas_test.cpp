// A gas of short bars in a closed box, all free: what collisions must keep. Blind to: which way a collision sends a
// bar, as long as it keeps momentum and energy (PenaltyBounce, BarImpact).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

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
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.contact.damping_ratio = 0.0;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.numerics.time_step_s = step;
  return spec;
}

/// Momentum along x and y, and about the origin. Positions and velocities half a step apart keep it to round-off.
struct Momentum {
  Vector2 linear = Vector2::Zero();
  double angular = 0.0;
  double speeds = 0.0;   // sum of m |v|
  double moments = 0.0;  // sum of |x m v|

  Momentum(const Scene& scene, const State& state) {
    for (std::size_t i = 0; i < scene.particle_count(); ++i) {
      const Vector2 momentum = scene.mass[i] * state.velocity[i];
      linear += momentum;
      angular += cross(state.position[i], momentum) + scene.inertia[i] * state.spin[i];
      speeds += momentum.norm();
      moments += state.position[i].norm() * momentum.norm();
    }
  }
};

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
  const Momentum before(*scene, simulation.state());
  Changes changes;
  std::int64_t touches = 0;
  std::int64_t touching = 0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    const ContactTotals& contacts = simulation.state().contact_totals;
    touches += std::max<std::int64_t>(0, contacts.count - touching);
    touching = contacts.count;
    if (simulation.step() % 100 != 0) continue;
    const Energies energies = evaluate_energies(*scene, simulation.state());
    const double sum = energies.kinetic + energies.elastic + contacts.stored;
    changes.energy = std::max(changes.energy, std::abs(sum / energies.initial - 1.0));
    changes.residual = std::max(changes.residual, std::abs(energies.residual / energies.initial));
  }
  const Momentum after(*scene, simulation.state());
  changes.linear = (after.linear - before.linear).norm() / before.speeds;
  changes.angular = (after.angular - before.angular) / before.moments;
  EXPECT_EQ(simulation.step(), scene->schedule.step_count) << simulation.status().message;
  EXPECT_GT(touches, 100);
  EXPECT_LT(simulation.state().contact_totals.deepest_penetration, 0.35);
  return changes;
}

TEST(Gas, OfBarsInAFreeBoxKeepsItsMomentaAndItsEnergy) {
  // A penalty contact begins and ends between two steps, so that the step decides how well a bounce keeps its energy.
  const Changes chosen = fly(1.0);
  const Changes fine = fly(0.1);
  EXPECT_LT(chosen.energy, 0.03);
  EXPECT_LT(fine.energy, 5e-4);
  EXPECT_LT(chosen.residual, 5e-4);
  EXPECT_LT(fine.residual, 5e-6);
  for (const Changes& changes : {chosen, fine}) {
    EXPECT_LT(changes.linear, 1e-12);
    EXPECT_LT(std::abs(changes.angular), 1e-12);
    scenes::record_bound("momentum", changes.linear);
    scenes::record_bound("angular momentum", changes.angular);
  }
  scenes::record_bound("energy at the chosen step", chosen.energy);
  scenes::record_bound("energy at a tenth of it", fine.energy);
  scenes::record_bound("residual at the chosen step", chosen.residual);
  scenes::record_bound("residual at a tenth of it", fine.residual);
}

}  // namespace
}  // namespace cellcrush::gas
