#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cellcrush/vector.h"

namespace cellcrush {

/// A function of time: linear between its points, constant outside them.
struct TimeFunction {
  std::vector<std::pair<double, double>> points;  ///< (s, value), times ascending, at least one

  [[nodiscard]] double value_at(double time) const;

  /// Its integral over the time from 0 on: exact at its points, and everywhere where it is constant.
  [[nodiscard]] TimeFunction integral() const;
};

/// One of the three degrees of freedom of a particle.
enum class Component { x, y, rotation };

/// A load on a node (E14).
struct NodalLoad {
  int node = 0;
  Component component = Component::x;
  TimeFunction value;  ///< N or N mm
};

/// A load distributed evenly over an element, in the fixed frame, per undeformed length (Eq. 4, E14).
struct ElementLoad {
  int element = 0;
  Component component = Component::x;  ///< x or y
  TimeFunction value;                  ///< N/mm
  double length = 0.0;                 ///< l_0, mm
};

/// How a support constrains one degree of freedom of a particle (E15).
struct Hold {
  static constexpr int kStill = -1;
  static constexpr int kWithImpactPlate = -2;

  bool held = false;
  int motion = kStill;  ///< index into Scene::motions of the imposed displacement, or one of the above
};

struct Support {
  Hold x;
  Hold y;
  Hold rotation;
};

/// Sides that repeat across the crush (E9i): a joint at the high side is the image of one at the low side, a period
/// further on. P pairs; none where the sides do not repeat.
struct Period {
  int axis = 0;           ///< across the crush, 0: x, 1: y
  double length = 0.0;    ///< mm, before loading
  bool is_fixed = false;  ///< whether the images keep their distance
  std::vector<int> low;   ///< P, joints
  std::vector<int> high;  ///< P, their images: they have no balls of their own

  [[nodiscard]] bool repeats() const { return !low.empty(); }
};

/// Particles that are held or moved as one by their supports, without turning (E15a).
struct Grip {
  enum class FixedTo { ground, impact_plate, support_plate };
  FixedTo fixed_to = FixedTo::ground;
  Hold x;  ///< of each of its particles
  Hold y;
  int first = 0;  ///< into Scene::gripped
  int end = 0;
  int taken = 0;  ///< particles beyond its line that something else holds; a scene that runs has none
};

/// The two rigid plates (E9c). The impact plate starts at the low end and moves along the crush; the support plate
/// stands still.
struct Plates {
  bool present = false;
  int axis = 0;               ///< 0: crush along x, 1: along y
  double impact_face = 0.0;   ///< mm, position of the face before loading
  double support_face = 0.0;  ///< mm
  double speed = 0.0;         ///< V, mm/s; the greatest if it is controlled
  double ramp_time = 0.0;     ///< s, time in which the speed rises linearly from 0
  /// Kinetic energy over the work done below which the speed is controlled (step/plate_control.h); 0: it is not.
  double kinetic_share = 0.0;
  double end_travel = 0.0;  ///< mm, at the end of a run whose speed is controlled
  double stiffness = 0.0;   ///< k, N/mm, penalty stiffness of one particle
  double friction = 0.0;    ///< Coulomb's coefficient

  /// Speed at a time, mm/s, if it is not controlled.
  [[nodiscard]] double speed_at(double time) const;
};

struct HalfPlaneKind;

/// A rigid wall: a half plane that pushes on the balls of all particles (E9f). It moves along its normal, as its kind
/// says.
struct RigidWall {
  const HalfPlaneKind* kind = nullptr;
  Vector2 point = Vector2::Zero();   ///< on its face at a displacement of 0, mm
  Vector2 normal = Vector2::Zero();  ///< unit, out of the wall
  bool at_edge = false;              ///< it touches the lattice before loading
  double friction = 0.0;             ///< Coulomb's coefficient
  TimeFunction motion;               ///< imposed displacement along the normal, mm
  TimeFunction velocity;             ///< mm/s, of which `motion` is the integral; without points: none is imposed
  double mass = 0.0;                 ///< tonne; 0: its motion is imposed
  double speed = 0.0;                ///< mm/s, along the normal at the start, of a mass
  TimeFunction force;                ///< N along the normal, on a mass; without points: none

  /// Positive direction of friction: the normal turned clockwise.
  [[nodiscard]] Vector2 tangent() const { return -normal_of(normal); }
  /// Greatest speed that its force gives a mass on a way, mm/s: by its impulse, or by its work if that is less.
  [[nodiscard]] double speed_by_force(double way) const;
  [[nodiscard]] bool moves() const { return mass > 0.0 || motion.points.size() > 1; }
  /// Whether the normals are opposite, within 2.5 degrees.
  [[nodiscard]] bool is_opposite_to(const RigidWall& other) const { return normal.dot(other.normal) <= -0.999; }
  /// Travel along the normal from one time to another, mm.
  [[nodiscard]] double travel_between(double from, double to) const {
    return motion.value_at(to) - motion.value_at(from);
  }
};

/// Rigid walls in place of the plates: strain, stresses and all that follows from them are theirs (push/crush.h).
/// Indices into Scene::rigid_walls. Two face each other, and one alone moves; or one stands at an edge, and the strain
/// is how much shorter the lattice has become.
struct CrushingWalls {
  static constexpr int kNone = -1;

  int impact = 0;         ///< the one that moves, or the only one
  int support = kNone;    ///< the one that stands still
  double distance = 0.0;  ///< of the faces where both touch the lattice before loading, or length of the lattice, mm
};

}  // namespace cellcrush
