#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

#include "contact/contact_tiles.h"
#include "contact/touch/force_laws.h"
#include "scenes/direction.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "scenes/probe.h"
#include "scenes/small_specimen.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using scenes::direction;
using scenes::Probe;

constexpr double kSticks = 1e6;  // as friction

// Couples on elements shorter than the walls are thick need forces greater than friction, which drive light particles.
TEST(RubbedSurface, FrictionOfShortElementsDoesNotOutpaceTheNormalForce) {
  for (const double length : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    std::vector<Vector2> chain;
    for (int i = -5; i <= 6; ++i) {
      chain.push_back({(i - 0.5) * length, 0.0});
    }
    Probe probe(chain, kSticks);
    probe.force_at({0.0, Probe::kDistance}, {0.0, 1.0});
    const double slip = 1e-6;
    const Vector2 friction = probe.drag_to({slip, Probe::kDistance}, {0.0, 1.0});
    double driven = 0.0;
    for (std::size_t i = 0; i < probe.scene().particle_count(); ++i) {
      driven += probe.state().friction_force[i].squaredNorm() * probe.scene().inverse_mass[i];
    }
    const double least = *std::min_element(probe.scene().mass.begin(), probe.scene().mass.end());
    const double squared_frequency = driven / (friction.norm() * slip);
    EXPECT_LT(squared_frequency, 3.0 * probe.stiffness() / least) << length;
    const double arm = 0.5 * Probe::kDistance;
    const double softening = 2.0 * (arm * arm / (length * length) + arm * arm / 100.0);  // the beam is 10 mm long
    EXPECT_NEAR(friction.norm() * std::max(1.0, softening), probe.stiffness() * slip, 1e-8 * probe.stiffness() * slip)
        << length;
  }
}

/// Walls of a crush that press on each other in all ways, without plates, and that friction holds as firmly as it may.
class HeldWalls {
 public:
  explicit HeldWalls(const SceneSpec& spec, int steps) : scene_(scenes::build(spec)) {
    state_ = make_initial_state(*scene_);
    for (int n = 0; n < steps; ++n) {
      advance_step(*scene_, state_, nullptr);
    }
    scene_->contact.friction = kSticks;
    scene_->contact.damping_ratio = 0.0;
  }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const State& state() const { return state_; }

  /// With the contacts of a step by these velocities, in which friction begins at 0.
  State after(const std::vector<Vector2>& velocity) const {
    State state = state_;
    state.velocity.assign(velocity.begin(), velocity.end());
    TouchMemory& touching = state.contacts.front().touching;
    touching.friction.assign(touching.count(), 0.0);
    clear_contact_forces(state, 0, static_cast<int>(scene_->particle_count()));
    ContactWorkspace contact;
    Workers workers(1);
    scenes::evaluate_wall_contacts(*scene_, state, contact, workers);
    return state;
  }

 private:
  std::shared_ptr<Scene> scene_;
  State state_;
};

/// Hexagons and thick squares, whose walls have grown, after contacts of all kinds.
std::vector<HeldWalls> held_walls() {
  SceneSpec squares = scenes::spec_of({"square", 200.0, 0.3}, 5, 4);
  scenes::cells_of(squares).wall_thickness_mm = 0.5;
  squares.elements_per_wall = 4;
  SceneSpec hexagons = scenes::spec_of({"hexagon", 100.0, 0.3}, 5, 4);
  scenes::cells_of(hexagons).wall_thickness_mm = 0.5;
  scenes::cells_of(hexagons).own["vertical_wall_thickness_mm"] = 0.35;
  std::vector<HeldWalls> all = {HeldWalls(squares, 1200), HeldWalls(hexagons, 750)};
  EXPECT_GT(*std::ranges::max_element(all.front().state().radius_growth), 0.05);
  return all;
}

double greatest_friction(const State& state) {
  double greatest = 0.0;
  for (const Vector2& force : state.friction_force) {
    greatest = std::max(greatest, force.norm());
  }
  return greatest;
}

std::vector<Vector2> random_velocities(std::size_t count, unsigned seed) {
  std::mt19937_64 generator(seed);
  const auto draw = [&] { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0; };
  std::vector<Vector2> velocities(count);
  for (Vector2& velocity : velocities) {
    velocity = {draw(), draw()};
  }
  return velocities;
}

double power(const State& state, const std::vector<Vector2>& velocity) {
  double sum = 0.0;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    sum += state.friction_force[i].dot(velocity[i]);
  }
  return sum;
}

// In a step by velocities u, friction that begins at 0 becomes -k slip(u) in each contact. If its forces are the
// transpose of the slip, their power over v is the same with u and v exchanged.
TEST(RubbedSurface, ForcesAreTheTransposeOfTheSlip) {
  double worst = 0.0;
  for (const HeldWalls& walls : held_walls()) {
    const std::vector<Vector2> u = random_velocities(walls.scene().particle_count(), 1);
    const std::vector<Vector2> v = random_velocities(walls.scene().particle_count(), 2);
    const State by_u = walls.after(u);
    const State by_v = walls.after(v);
    EXPECT_GT(by_u.contact_totals.count, 15);
    EXPECT_LT(power(by_u, u), 0.0);
    worst = std::max(worst, std::abs((power(by_u, v) - power(by_v, u)) / power(by_u, u)));
  }
  EXPECT_LT(worst, 1e-12);
  scenes::record_bound("difference of powers", worst);
}

TEST(RubbedSurface, ForcesBalanceInForceAndMoment) {
  double worst = 0.0;
  for (const HeldWalls& walls : held_walls()) {
    const State state = walls.after(random_velocities(walls.scene().particle_count(), 3));
    Vector2 force = Vector2::Zero();
    double moment = 0.0;
    double forces = 0.0;
    for (std::size_t i = 0; i < walls.scene().particle_count(); ++i) {
      force += state.friction_force[i];
      moment += cross(state.position[i], state.friction_force[i]);
      forces += state.friction_force[i].norm();
    }
    worst = std::max({worst, force.norm() / forces, std::abs(moment) / (walls.scene().length * forces)});
  }
  EXPECT_LT(worst, 1e-13);
  scenes::record_bound("imbalance", worst);
}

// By a tenth of a radian in one step, much more than any crush has.
TEST(RubbedSurface, WallsThatTurnTogetherDevelopNoFriction) {
  double worst = 0.0;
  for (const HeldWalls& walls : held_walls()) {
    std::vector<Vector2> velocity;
    for (const Vector2& place : walls.state().position) {
      const Vector2 before = std::cos(0.1) * place - std::sin(0.1) * normal_of(place);
      velocity.push_back((place - before) / walls.scene().schedule.time_step);
    }
    const double rubbed = greatest_friction(walls.after(random_velocities(velocity.size(), 4)));
    ASSERT_GT(rubbed, 0.0);
    // Friction by a slip of a hundredth of a wall.
    const double unit = 0.01 * walls.scene().contact.thinnest * walls.scene().contact.stiffness;
    worst = std::max(worst, greatest_friction(walls.after(velocity)) / unit);
  }
  EXPECT_LT(worst, 1e-10);
  scenes::record_bound("friction of a turn over that of 0.01 h", worst);
}

}  // namespace
}  // namespace cellcrush
