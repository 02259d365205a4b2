// What acts at the surfaces of walls in a crush, after contacts of all kinds: friction, and contact as walls grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "beam/internal_forces.h"
#include "contact/contact_tiles.h"
#include "contact/thickening.h"
#include "contact/touch/force_laws.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "scenes/probe.h"

namespace cellcrush {
namespace {

using scenes::Probe;

constexpr double kHolds = 1e6;  // as friction

// Couples on elements shorter than the walls are thick need forces greater than friction, which drive light particles.
TEST(RubbedSurface, FrictionOfShortElementsDoesNotOutpaceTheNormalForce) {
  for (const double length : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    std::vector<Vector2> chain;
    for (int i = -5; i <= 6; ++i) chain.push_back({(i - 0.5) * length, 0.0});
    Probe probe(chain, kHolds);
    probe.force_at({0.0, Probe::kDistance}, {0.0, 1.0});
    const double slip = 1e-6;
    const Vector2 friction = probe.drag_to({slip, Probe::kDistance}, {0.0, 1.0});
    double driven = 0.0;
    for (std::size_t i = 0; i < probe.scene().particle_count(); ++i) {
      driven += probe.state().friction_force[i].squaredNorm() * probe.scene().inverse_mass[i];
    }
    const double squared_frequency = driven / (friction.norm() * slip);
    EXPECT_LT(squared_frequency, 3.0 * probe.stiffness() / std::ranges::min(probe.scene().mass)) << length;
    const double arm = 0.5 * Probe::kDistance;
    const double softening = 2.0 * (arm * arm / (length * length) + arm * arm / 100.0);  // the beam is 10 mm long
    EXPECT_NEAR(friction.norm() * std::max(1.0, softening), probe.stiffness() * slip, 1e-8 * probe.stiffness() * slip)
        << length;
  }
}

/// Thick squares, squashed at 200 m/s.
SceneSpec squashed_squares() {
  SceneSpec spec = scenes::spec_of({"square", 200.0, 0.3}, 5, 4);
  scenes::cells_of(spec).wall_thickness_mm = 0.5;
  spec.elements_per_wall = 4;
  return spec;
}

/// Walls of a crush that press on each other in all ways, without plates, and that friction holds as firmly as it may.
class HeldWalls {
 public:
  HeldWalls(const SceneSpec& spec, int steps) : scene(scenes::build(spec)), state(scenes::state_after(*scene, steps)) {
    scene->contact.friction = kHolds;
    scene->contact.damping_ratio = 0.0;
  }

  /// With the contacts of a step by these velocities, in which friction begins at 0.
  [[nodiscard]] State after(const std::vector<Vector2>& velocity) const {
    State moved = state;
    moved.velocity.assign(velocity.begin(), velocity.end());
    TouchMemory& touching = moved.contacts.front().touching;
    touching.friction.assign(touching.count(), 0.0);
    clear_contact_forces(moved, 0, static_cast<int>(scene->particle_count()));
    ContactWorkspace contact;
    Workers workers(1);
    scenes::evaluate_wall_contacts(*scene, moved, contact, workers);
    return moved;
  }

  [[nodiscard]] std::vector<Vector2> random_velocities(unsigned seed) const {
    std::mt19937_64 generator(seed);
    const auto draw = [&] { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0; };
    std::vector<Vector2> velocities(scene->particle_count());
    for (Vector2& velocity : velocities) velocity = {draw(), draw()};
    return velocities;
  }

  std::shared_ptr<Scene> scene;
  State state;
};

/// Hexagons and thick squares, whose walls have grown.
std::vector<HeldWalls> held_walls() {
  SceneSpec hexagons = scenes::spec_of({"hexagon", 100.0, 0.3}, 5, 4);
  scenes::cells_of(hexagons).wall_thickness_mm = 0.5;
  scenes::cells_of(hexagons).own["vertical_wall_thickness_mm"] = 0.35;
  hexagons.elements_per_wall = 2;
  std::vector<HeldWalls> all = {HeldWalls(squashed_squares(), 800), HeldWalls(hexagons, 640)};
  EXPECT_GT(*std::ranges::max_element(all.front().state.radius_growth), 0.05);
  return all;
}

double greatest_friction(const State& state) {
  double greatest = 0.0;
  for (const Vector2& force : state.friction_force) greatest = std::max(greatest, force.norm());
  return greatest;
}

double power(const State& state, const std::vector<Vector2>& velocity) {
  double sum = 0.0;
  for (std::size_t i = 0; i < velocity.size(); ++i) sum += state.friction_force[i].dot(velocity[i]);
  return sum;
}

// In a step by velocities u, friction that begins at 0 becomes -k slip(u) in each contact. If its forces are the
// transpose of the slip, their power over v is the same with u and v exchanged.
TEST(RubbedSurface, ForcesAreTheTransposeOfTheSlip) {
  double worst = 0.0;
  for (const HeldWalls& walls : held_walls()) {
    const std::vector<Vector2> u = walls.random_velocities(1);
    const std::vector<Vector2> v = walls.random_velocities(2);
    const State by_u = walls.after(u);
    EXPECT_GT(by_u.contact_totals.count, 15);
    EXPECT_LT(power(by_u, u), 0.0);
    worst = std::max(worst, std::abs((power(by_u, v) - power(walls.after(v), u)) / power(by_u, u)));
  }
  scenes::record_bound("difference of powers", worst, 1e-12);
}

TEST(RubbedSurface, ForcesBalanceInForceAndMoment) {
  double worst = 0.0;
  for (const HeldWalls& walls : held_walls()) {
    const State state = walls.after(walls.random_velocities(3));
    Vector2 force = Vector2::Zero();
    double moment = 0.0;
    double forces = 0.0;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      force += state.friction_force[i];
      moment += cross(state.position[i], state.friction_force[i]);
      forces += state.friction_force[i].norm();
    }
    worst = std::max({worst, force.norm() / forces, std::abs(moment) / (walls.scene->length * forces)});
  }
  scenes::record_bound("imbalance", worst, 1e-13);
}

// By a tenth of a radian in one step, much more than any crush has.
TEST(RubbedSurface, WallsThatTurnTogetherDevelopNoFriction) {
  double worst = 0.0;
  for (const HeldWalls& walls : held_walls()) {
    std::vector<Vector2> velocity;
    for (const Vector2& place : walls.state.position) {
      const Vector2 before = std::cos(0.1) * place - std::sin(0.1) * normal_of(place);
      velocity.push_back((place - before) / walls.scene->schedule.time_step);
    }
    ASSERT_GT(greatest_friction(walls.after(walls.random_velocities(4))), 0.0);
    // Friction by a slip of a hundredth of a wall.
    const double unit = 0.01 * walls.scene->contact.thinnest * walls.scene->contact.stiffness;
    worst = std::max(worst, greatest_friction(walls.after(velocity)) / unit);
  }
  scenes::record_bound("friction of a turn over that of 0.01 h", worst, 1e-10);
}

/// Contacts of a state whose particles have been moved by hand.
class MovedContacts {
 public:
  MovedContacts(const Scene& scene, const State& state) : scene_(scene), base_(state) {}

  /// With one particle moved by `way`.
  const State& with(std::size_t particle, const Vector2& way) {
    moved_ = base_;
    moved_.position[particle] += way;
    size_thickening_step(scene_, moved_);
    deform_walls(scene_, moved_, walls_, workers_);
    clear_contact_forces(moved_, 0, static_cast<int>(scene_.particle_count()));
    scenes::evaluate_wall_contacts(scene_, moved_, contact_, workers_);
    return moved_;
  }

 private:
  const Scene& scene_;
  const State& base_;
  State moved_;
  WallsWorkspace walls_;
  ContactWorkspace contact_;
  Workers workers_{1};
};

bool has_grown(const State& state, const TouchMemory& touching, std::size_t t, const Element& segment) {
  return state.radius_growth[touching.ball[t]] > 0.0 || state.radius_growth[segment.start] > 0.0 ||
         state.radius_growth[segment.end] > 0.0;
}

// Contacts that lose nothing. Blind to: plates, friction and the viscous force.
TEST(Thickening, ForcesOfContactsAreTheGradientOfTheirEnergyWhileWallsGrow) {
  double worst = 0.0;
  for (const auto plane : {MaterialSpec::Plane::stress, MaterialSpec::Plane::strain}) {
    SceneSpec spec = scenes::in_double_precision(squashed_squares());
    spec.material.plane = plane;
    spec.contact.damping_ratio = 0.0;
    const auto scene = scenes::build(spec);
    const State state = scenes::state_after(*scene, 800);
    const TouchMemory& touching = state.contacts.front().touching;
    std::size_t grown = 0;
    for (std::size_t t = 0; t < touching.count(); ++t) {
      grown += has_grown(state, touching, t, scene->elements[touching.segment[t]]) ? 1 : 0;
    }
    EXPECT_GT(grown, 5U) << "of " << touching.count();
    MovedContacts contacts(*scene, state);
    const auto forces = contacts.with(0, Vector2::Zero()).contact_force;
    double largest = 0.0;
    for (const ContactForce& force : forces) largest = std::max(largest, force.elastic.norm());
    constexpr double kWay = 1e-7;  // mm
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (const Vector2& along : {Vector2(Vector2::UnitX()), Vector2(Vector2::UnitY())}) {
        const double ahead = contacts.with(i, kWay * along).contact_totals.stored;
        const double behind = contacts.with(i, -kWay * along).contact_totals.stored;
        worst = std::max(worst, std::abs(forces[i].elastic.dot(along) + (ahead - behind) / (2.0 * kWay)) / largest);
      }
    }
  }
  scenes::record_bound("difference over the largest force", worst, 1e-4);
}

}  // namespace
}  // namespace cellcrush
