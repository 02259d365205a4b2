#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reference/reference_element.h"

namespace cellcrush::reference {

/// A segment of the mid-lines, with its round ends a capsule. An element's, or a wall's of a rigid body.
struct Segment {
  int start = 0;  ///< particle
  int end = 0;    ///< particle
  double thickness = 0.0;
  Material material;
  bool in_pair = false;  ///< solved with its neighbour (E5b)
};

/// Penalty contact between walls (Eq. 43-47, E9).
struct ContactData {
  double stiffness = 0.0;      ///< k, N/mm
  double damping_ratio = 0.0;  ///< zeta
  double friction = 0.0;       ///< mu
};

/// Plates at the low and the high end of an axis; that at the low end moves.
struct PlateData {
  int axis = 0;  ///< 0: x, 1: y
  double impact_face = 0.0;
  double support_face = 0.0;
  double speed = 0.0;
  double ramp_time = 0.0;  ///< s in which the speed rises
  double stiffness = 0.0;
  double friction = 0.0;
};

/// Particles that move as one body (E13).
struct BodyData {
  int first = 0;  ///< particle
  int end = 0;
};

/// A lattice between two plates. Units mm, tonne, s, N, MPa.
struct Lattice {
  std::vector<Vector> position;
  std::vector<Segment> segments;  ///< those of rigid bodies last
  int element_count = 0;          ///< segments that are elements
  /// The elements of each wall between two joints, one after another: each ends where the next one starts.
  std::vector<std::vector<int>> walls;
  std::vector<BodyData> bodies;
  ElementRule rule;
  double depth = 0.0;
  ContactData contact;
  PlateData plates;
  double mass_damping = 0.0;  ///< alpha of E2
  double time_step = 0.0;

  /// Those that end at a particle.
  [[nodiscard]] std::vector<int> segments_at(int particle) const;
};

/// Particles' masses and balls.
struct Particles {
  std::vector<double> mass;
  std::vector<double> inertia;
  std::vector<double> radius;
  std::vector<std::vector<int>> grown_with;
};
Particles lump(const Lattice& lattice);

ElementData element_data_of(const Lattice& lattice, int segment);

/// What half of the thickness of a segment has grown by (E5f), with its nodes at these positions.
Thickening thickening_of(const Lattice& lattice, int segment, const std::vector<Vector>& position);

/// Of each ball, the elements with which it grows, by the mean of both: those of a particle inside a wall, or none.
std::vector<std::vector<int>> grown_with(const Lattice& lattice);

/// Particles at a time, with their velocities of half a step before.
struct Motion {
  std::vector<Vector> position;
  std::vector<Vector> velocity;
};

/// Forces of contacts and plates on the particles, N, and what they come to.
struct ContactForces {
  std::vector<Vector> elastic;
  std::vector<Vector> viscous;
  std::vector<Vector> friction;
  double impact_elastic = 0.0;  ///< of the impact plate on the lattice, along the crush
  double impact_viscous = 0.0;
  double support = 0.0;  ///< of the support plate on the lattice, against the crush
  double stored = 0.0;   ///< N mm (E8b), plates included
  int count = 0;         ///< touches of walls that push
};

/// History of a ball and a segment.
struct Pair {
  double reach = 0.0;     ///< mm, distance at which they touch before loading; 0 for a ball at an end of the segment
  double most = 0.0;      ///< mm, the greatest (E8a)
  int side = 0;           ///< of the segment, from which the ball came: +1 left, -1 right; 0: they do not touch
  bool rubs = false;      ///< whether their touch carried friction in the newest step
  double friction = 0.0;  ///< N, on the ball, along the normal turned right
};

/// Histories of every ball with every segment, segments innermost, before the first step.
std::vector<Pair> no_contact(const Lattice& lattice, const Particles& particles);

/// What the radius of a ball has grown by (E5f), mm, and the forces on the ends of the elements with which it grows, if
/// `force` presses against it (E8d).
double growth_of_ball(const Lattice& lattice, const Particles& particles, const Motion& motion, int ball);
void push_elements_apart(const Lattice& lattice, const Particles& particles, const Motion& motion, int ball,
                         double force, ContactForces& forces);

/// Adds the forces of the walls on each other (Eq. 41-47, E8, E8b, E9): every ball against every segment.
void push_walls(const Lattice& lattice, const Particles& particles, const Motion& motion, std::vector<Pair>& pairs,
                ContactForces& forces);

/// Viscous part of a penalty force (Eq. 43, E9) that does not pull. `approach` is dD/dt.
inline double viscous_force(double stiffness, double damping_ratio, double inverse_mass, double approach,
                            double elastic) {
  const double damping = 2.0 * damping_ratio * std::sqrt(stiffness / inverse_mass);  // c
  return std::max(damping * approach, -elastic);
}

/// Friction after a slip (Eq. 44-47, E9b).
inline double friction_after(double before, double stiffness, double slip, double limit) {
  return std::clamp(before - stiffness * slip, -limit, limit);
}

/// A surface on which friction acts (E9d).
struct Rim {
  std::vector<int> segments;  ///< with which it turns
  double arm;                 ///< mm, of friction

  /// Speed at which the surface runs, by its turning to the left, mm/s.
  [[nodiscard]] double speed(const Lattice& lattice, const Motion& motion) const;

  /// Adds the forces by which a friction force (N) turns the surface to the left.
  void turn(const Lattice& lattice, const Motion& motion, double friction, std::vector<Vector>& forces) const;

  /// Twice the square of the arm over the length of the segments.
  [[nodiscard]] double leverage(const Lattice& lattice, const Motion& motion) const;
};

/// Friction of the plates on every particle in the newest step, N, across the crush.
struct PlateHistory {
  std::vector<double> impact_friction;
  std::vector<double> support_friction;
};

/// Adds the forces of the plates on every particle (Eq. 43-47, E9). The impact plate has come by `travel` (mm); its
/// speed is that of half a step before.
void push_plates(const Lattice& lattice, const Particles& particles, const Motion& motion, double travel, double speed,
                 PlateHistory& history, ContactForces& forces);

/// The ledger (E10), N mm.
struct Energies {
  double kinetic = 0.0;
  double elastic = 0.0;
  double plastic = 0.0;
  double contact = 0.0;
  double contact_damping = 0.0;
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;
};

/// All of a crush from which the next step follows, but the histories of contacts and the motion of rigid bodies.
struct Instant {
  Motion motion;
  std::vector<double> spin;  ///< half a step before
  std::vector<ElementHistory> elements;
  std::vector<Vector> force;   ///< on the particles, mass damping aside
  std::vector<double> moment;  ///< on the particles
};

/// A lattice in motion (Eq. 1-6, E1, E2, E10, E13): central differences, velocities half a step before and after the
/// time.
class Crush {
 public:
  explicit Crush(Lattice lattice);

  /// A step.
  void advance();

  /// Goes on from another instant.
  void adopt(Instant instant);

  [[nodiscard]] const Instant& instant() const { return now_; }
  [[nodiscard]] const ContactForces& contacts() const { return contacts_; }
  [[nodiscard]] Energies energies() const;

 private:
  /// A body's centre and turn, and its velocities half a step before and after the time.
  struct Body {
    BodyData data;
    double mass;
    double inertia;
    Vector first_centre;
    Vector centre;
    Vector velocity;
    Vector next_velocity;
    double rotation;
    double spin;
    double next_spin;
  };

  [[nodiscard]] double speed_at(double time) const;
  void gather_bodies();
  void evaluate_forces();
  void resist(const std::vector<int>& unit, double step);
  void find_next_velocities();
  void find_next_velocities_of(Body& body);
  [[nodiscard]] Vector position_in(const Body& body, std::size_t particle) const;
  void add_works(const std::vector<Vector>& velocity, const std::vector<double>& spin, double plate_speed);

  const Lattice lattice_;
  const Particles particles_;
  double time_ = 0.0;
  double travel_ = 0.0;  // of the impact plate
  Instant now_;
  std::vector<Vector> next_velocity_;  // half a step after
  std::vector<double> next_spin_;
  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
  PlateHistory plate_history_;
  ContactForces contacts_;
  Energies works_;
};

}  // namespace cellcrush::reference
