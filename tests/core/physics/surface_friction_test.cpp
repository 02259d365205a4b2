// Friction acts at the surfaces of walls (E9d): it turns what slides, and leaves what rolls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

enum class Floor { wall, plate };

constexpr double kRingRadius = 5.0;   // mm, of the mid-line
constexpr double kRingSpeed = 1e4;    // mm/s
constexpr double kRingGravity = 1e7;  // mm/s^2
constexpr double kCoefficient = 0.3;  // of friction

/// How a ring starts.
struct Start {
  Floor floor = Floor::wall;
  int corners = 48;
  double thickness = 1.0;  // mm
  bool rolls = true;       // else it slides
  /// Contacts so soft that the ring sinks in by 0.02 mm, more than the edges of the polygon stand out, and without
  /// damping. Then it does not jolt from corner to corner.
  bool is_soft = true;
};

/// A ring of straight elements that is let go on a plate, or on a flat wall: one element that is held at its ends.
class Ring {
 public:
  explicit Ring(const Start& start) : start_(start) {
    const double turning = start.rolls ? kRingSpeed / rolling_radius() : 0.0;
    FrameLattice frame;
    for (int i = 0; i < start.corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / start.corners;
      const Vector2 place = kRingRadius * Vector2(std::sin(angle), std::cos(angle));
      frame.nodes.push_back({place.x(), place.y(), 0.0, 0.0});
      frame.beams.push_back(scenes::beam(i, (i + 1) % start.corners, start.thickness, 1));
      frame.initial_velocities.push_back(
          {i, 1e-3 * (kRingSpeed + turning * place.y()), -1e-3 * turning * place.x(), -turning});
    }
    const double surface = -kRingRadius * std::cos(std::numbers::pi / start.corners) - 0.5 * start.thickness - 1e-9;
    for (const double x : {-50.0, 250.0}) {
      frame.supports.push_back({static_cast<int>(frame.nodes.size()), true, true, true});
      frame.nodes.push_back({x, surface - 0.5 * start.thickness, 0.0, 0.0});
    }
    frame.beams.push_back(scenes::beam(start.corners, start.corners + 1, start.thickness, 1));
    frame.gravity_y_m_per_s2 = -1e-3 * kRingGravity;
    frame.self_contact = true;
    SceneSpec spec = scenes::elastic_frame(frame);
    spec.contact.friction = kCoefficient;
    scene_ = scenes::build(spec);
    if (start.is_soft) {
      scene_->contact.damping_ratio = 0.0;
      scene_->contact.stiffness = mass() * kRingGravity / kSunk;
    }
    lay_floor(surface + (start.is_soft ? kSunk : 0.0));
    state_ = make_initial_state(*scene_);
  }

  void advance(double duration) {
    const auto steps = static_cast<int>(duration / scene_->schedule.time_step);
    for (int i = 0; i < steps; ++i) {
      advance_step(*scene_, state_, nullptr);
    }
  }

  /// From the middle of the ring to the point of contact, which is half of the overlap above the surface of the floor
  /// if that is a wall.
  [[nodiscard]] double rolling_radius() const {
    const double sunk = start_.is_soft ? kSunk : 0.0;
    return kRingRadius + 0.5 * start_.thickness - (start_.floor == Floor::wall ? 0.5 : 1.0) * sunk;
  }

  [[nodiscard]] double mass() const {
    double mass = 0.0;
    for (int i = 0; i < start_.corners; ++i) {
      mass += scene_->mass[i];
    }
    return mass;
  }

  [[nodiscard]] double inertia() const {
    double inertia = 0.0;
    for (int i = 0; i < start_.corners; ++i) {
      inertia += scene_->mass[i] * kRingRadius * kRingRadius + scene_->inertia[i];
    }
    return inertia;
  }

  [[nodiscard]] double speed() const {
    double momentum = 0.0;
    for (int i = 0; i < start_.corners; ++i) {
      momentum += scene_->mass[i] * state_.velocity[i].x();
    }
    return momentum / mass();
  }

  /// Over the kinetic energy at the start.
  [[nodiscard]] double friction() const { return energies().friction / state_.ledger.initial; }
  [[nodiscard]] double residual() const { return energies().residual / state_.ledger.initial; }
  [[nodiscard]] double contact_damping() const { return energies().contact_damping / state_.ledger.initial; }

 private:
  static constexpr double kSunk = 0.02;  // mm

  [[nodiscard]] Energies energies() const { return evaluate_energies(*scene_, state_); }

  /// Raises the wall, or replaces it by a plate.
  void lay_floor(double surface) {
    for (const int end : {start_.corners, start_.corners + 1}) {
      scene_->position[end].y() = surface - (start_.floor == Floor::wall ? 0.5 * start_.thickness : 20.0);
    }
    if (start_.floor == Floor::plate) {
      Plates& plates = scene_->plates;
      plates.present = true;
      plates.axis = 1;
      plates.impact_face = surface;
      plates.support_face = 1000.0;
      plates.stiffness = scene_->contact.stiffness;
      plates.friction = kCoefficient;
      scene_->contact.friction = 0.0;
    }
  }

  Start start_;
  std::shared_ptr<Scene> scene_;
  State state_;
};

constexpr double kHalfTurn = std::numbers::pi * kRingRadius / kRingSpeed;  // s

// With friction at the mid-lines, a ring that turns by its outer radius would lose h / 4 / (radius + h / 2) of its
// speed, and more as it is thicker: 4.5 and 8.3 % here.
TEST(RollingRing, KeepsItsSpeed) {
  for (const Floor floor : {Floor::wall, Floor::plate}) {
    for (const double thickness : {1.0, 2.0}) {
      Ring ring({.floor = floor, .thickness = thickness});
      double worst = 0.0;
      for (int turns = 0; turns < 4; ++turns) {
        ring.advance(kHalfTurn);
        worst = std::max(worst, std::abs(ring.speed() / kRingSpeed - 1.0));
      }
      const std::string on = floor == Floor::wall ? " on a wall" : " on a plate";
      scenes::record_bound("change of speed in %" + on, 100.0 * worst, 0.3);
      scenes::record_bound("heat" + on, ring.friction(), 2e-4);
      scenes::record_bound("residual" + on, ring.residual(), 1e-8);
    }
  }
}

// A polygon of n corners, stiff and damped, rolls by jolts and loses energy to contacts, by pi^2 / n of its turning in
// a turn if it does not bounce. This is a matter of its mesh, and not of friction.
TEST(RollingRing, LosesWhatItsCornersTakeWhichFallsWithTheMesh) {
  double coarser = 1.0;
  for (const int corners : {24, 48, 96}) {
    Ring ring({.corners = corners, .is_soft = false});
    ring.advance(2.0 * kHalfTurn);
    const double lost = 1.0 - ring.speed() / kRingSpeed;
    EXPECT_LT(lost, 0.8 * coarser) << corners;
    EXPECT_GT(ring.contact_damping(), ring.friction()) << corners;
    coarser = lost;
    scenes::record_bound("lost by " + std::to_string(corners) + " corners in %", 100.0 * lost);
  }
}

// The impulse of friction P slows it by P / m and turns it by P a / J, with the rolling radius a, until v = a omega.
TEST(SlidingRing, GoesOverToRollingAtTheSpeedOfTheClosedForm) {
  double apart_from_half = 1.0;
  for (const double thickness : {2.0, 1.0, 0.5}) {
    for (const Floor floor : {Floor::wall, Floor::plate}) {
      Ring ring({.floor = floor, .thickness = thickness, .rolls = false});
      const double slides = 0.6 * kRingSpeed / (kCoefficient * kRingGravity);  // s, at most
      ring.advance(slides);
      const double ratio = 1.0 / (1.0 + ring.inertia() / (ring.mass() * ring.rolling_radius() * ring.rolling_radius()));
      double mean = 0.0;
      constexpr int kSamples = 10;
      for (int i = 0; i < kSamples; ++i) {
        ring.advance(0.2 * kHalfTurn);
        mean += ring.speed() / kSamples;
      }
      EXPECT_LT(std::abs(ring.residual()), 1e-8) << thickness;
      scenes::record_bound("speed error in %", 100.0 * (mean / (ratio * kRingSpeed) - 1.0), 1.0);
      // Kinetic energy lost: that of the sliding part of the motion, (1 - ratio) of it.
      EXPECT_NEAR(ring.friction(), 1.0 - ratio, 0.01) << thickness;
      if (floor == Floor::wall) {
        EXPECT_LT(std::abs(ratio - 0.5), apart_from_half);
        apart_from_half = std::abs(ratio - 0.5);
      }
    }
  }
  EXPECT_LT(apart_from_half, 0.03);  // a thin ring keeps half of its speed
}

constexpr double kPassing = 2e-3;  // s

/// Two free bars of `elements` elements that rub against each other as they pass.
struct Bars {
  std::shared_ptr<Scene> scene;
  State state;

  explicit Bars(int elements, double friction) {
    FrameLattice frame =
        scenes::touching_beams({{-12.0, 0.0}, {12.0, 0.3}, {-8.0, 1.3}, {9.0, 1.6}}, {{0, 1}, {2, 3}}, 1.0, elements);
    frame.beams[1].thickness_mm = 1.2;
    frame.initial_velocities = {{0, 3.0, 0.0, 0.0}, {1, 3.0, 0.0, 0.0}, {2, -4.0, -2.0, 0.0}, {3, -4.0, -2.0, 0.0}};
    SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(frame));
    spec.contact.friction = friction;
    scene = scenes::build(spec);
    state = make_initial_state(*scene);
  }
};

// With friction at the mid-lines, they would lose its impulse times their distance.
TEST(RubbingBars, KeepTheirAngularMomentum) {
  for (const int elements : {1, 3, 4}) {
    Bars bars(elements, kCoefficient);
    const double start = scenes::momentum_of(*bars.scene, bars.state).angular;
    double impulse = 0.0;
    double worst = 0.0;
    while (bars.state.time < kPassing) {
      advance_step(*bars.scene, bars.state, nullptr);
      Vector2 force = Vector2::Zero();
      for (std::size_t i = 0; i < bars.scene->particle_count(); ++i) {
        const bool is_upper = bars.scene->position[i].y() > 0.8;
        force += is_upper ? bars.state.friction_force[i] : Vector2(Vector2::Zero());
      }
      impulse += bars.scene->schedule.time_step * force.norm();
      worst = std::max(worst, std::abs(scenes::momentum_of(*bars.scene, bars.state).angular - start));
    }
    const double lost_at_mid_lines = impulse * 1.1;
    EXPECT_GT(lost_at_mid_lines, 1e-3 * std::abs(start)) << elements;
    scenes::record_bound("change over impulse times distance", worst / lost_at_mid_lines, 1e-9);
  }
}

// The residual is that of elements that vibrate, as without friction.
TEST(RubbingBars, TurnIntoHeatWhatFrictionTakes) {
  for (const int elements : {1, 3, 4}) {
    for (const double friction : {0.0, kCoefficient}) {
      Bars bars(elements, friction);
      while (bars.state.time < kPassing) {
        advance_step(*bars.scene, bars.state, nullptr);
      }
      const Energies energies = evaluate_energies(*bars.scene, bars.state);
      const double residual = energies.residual / bars.state.ledger.initial;
      EXPECT_EQ(energies.friction > 0.001 * bars.state.ledger.initial, friction > 0.0) << elements;
      scenes::record_bound(friction > 0.0 ? "residual" : "residual without friction", residual, 1e-4);
    }
  }
}

}  // namespace
}  // namespace cellcrush
