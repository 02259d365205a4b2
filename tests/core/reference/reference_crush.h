#pragma once

#include <vector>

#include "core/reference/reference_contact.h"
#include "core/reference/reference_lattice.h"
#include "core/reference/reference_plates.h"

namespace cellcrush::reference {

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
