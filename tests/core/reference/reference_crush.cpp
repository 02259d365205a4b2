#include "core/reference/reference_crush.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cellcrush::reference {

void push_plates(const Lattice& lattice, const Particles& particles, const Motion& motion, double travel, double speed,
                 PlateHistory& history, ContactForces& forces) {
  const PlateData& plates = lattice.plates;
  const int along = plates.axis;
  const int across = 1 - along;
  // Returns the elastic and the viscous force on a particle, towards the inside of the lattice.
  const auto push = [&](std::size_t i, double face, double velocity, double inward, double& friction) {
    const int ball = static_cast<int>(i);
    const double radius = particles.radius[i] + growth_of_ball(lattice, particles, motion, ball);  // E5f
    const double surface = motion.position[i][along] - inward * radius;
    const double depth = std::max(inward * (face - surface), 0.0);  // D
    const double elastic = plates.stiffness * depth;
    const double approach = inward * (velocity - motion.velocity[i][along]);  // dD/dt
    const double viscous = depth > 0.0 ? viscous_force(plates.stiffness, lattice.contact.damping_ratio,
                                                       1.0 / particles.mass[i], approach, elastic)
                                       : 0.0;
    forces.elastic[i][along] += inward * elastic;  // Eq. 43
    forces.viscous[i][along] += inward * viscous;
    forces.stored += elastic * depth / 2.0;
    push_elements_apart(lattice, particles, motion, ball, elastic, forces);  // E8d
    // Friction acts where the ball meets the plate (E9d). A turn to the left moves that point along the normal, turned
    // right.
    Vector normal = Vector::Zero();
    normal[along] = inward;
    const Rim rim = {lattice.segments_at(ball), inward * (motion.position[i][along] - face)};
    const double ahead = turned_right(normal)[across];
    const double slide = motion.velocity[i][across] + ahead * rim.speed(lattice, motion);
    const double stiffness = plates.stiffness / std::max(rim.leverage(lattice, motion), 1.0);
    friction = friction_after(friction, stiffness, lattice.time_step * slide,  // Eq. 44
                              plates.friction * (elastic + viscous));
    forces.friction[i][across] += friction;
    rim.turn(lattice, motion, ahead * friction, forces.friction);
    return std::pair(elastic, viscous);
  };
  for (std::size_t i = 0; i < motion.position.size(); ++i) {
    const auto impact = push(i, plates.impact_face + travel, speed, 1.0, history.impact_friction[i]);
    forces.impact_elastic += impact.first;
    forces.impact_viscous += impact.second;
    const auto support = push(i, plates.support_face, 0.0, -1.0, history.support_friction[i]);
    forces.support += support.first + support.second;
  }
}

Crush::Crush(Lattice lattice)
    : lattice_(std::move(lattice)), particles_(lump(lattice_)), pairs_(no_contact(lattice_, particles_)) {
  const std::size_t count = lattice_.position.size();
  plate_history_ = {std::vector<double>(count), std::vector<double>(count)};
  now_.motion = {lattice_.position, std::vector<Vector>(count, Vector::Zero())};
  now_.spin.assign(count, 0.0);
  for (int e = 0; e < lattice_.element_count; ++e) {
    const Segment& segment = lattice_.segments[e];
    now_.elements.push_back(
        undeformed(lattice_.rule, lattice_.position[segment.start], lattice_.position[segment.end]));
  }
  gather_bodies();
  evaluate_forces();
  // At rest at time 0: the velocities half a step before are those half a step after, reversed.
  find_next_velocities();
  for (Body& body : bodies_) {
    body.velocity = -0.5 * body.next_velocity;
    body.spin = -0.5 * body.next_spin;
  }
  for (std::size_t i = 0; i < count; ++i) {
    now_.motion.velocity[i] = -0.5 * next_velocity_[i];
    now_.spin[i] = -0.5 * next_spin_[i];
  }
  find_next_velocities();
}

/// Speed of the impact plate.
double Crush::speed_at(double time) const {
  const PlateData& plates = lattice_.plates;
  const bool rises = plates.ramp_time > 0.0 && time < plates.ramp_time;
  return rises ? plates.speed * std::max(time, 0.0) / plates.ramp_time : plates.speed;
}

void Crush::gather_bodies() {
  for (const BodyData& data : lattice_.bodies) {
    Body body = {data, 0.0, 0.0, Vector::Zero(), {}, Vector::Zero(), Vector::Zero(), 0.0, 0.0, 0.0};
    for (int i = data.first; i < data.end; ++i) {
      body.mass += particles_.mass[i];
      body.first_centre += particles_.mass[i] * lattice_.position[i];
    }
    body.first_centre /= body.mass;
    body.centre = body.first_centre;
    for (int i = data.first; i < data.end; ++i) {
      body.inertia += particles_.inertia[i] + particles_.mass[i] * (lattice_.position[i] - body.centre).squaredNorm();
    }
    bodies_.push_back(body);
  }
}

/// Adds the resistance of the elements of a unit to a step.
void Crush::resist(const std::vector<int>& unit, double step) {
  std::vector<MovedElement> moved;
  for (const int e : unit) {
    const int start = lattice_.segments[e].start;
    const int end = lattice_.segments[e].end;
    moved.push_back(
        {element_data_of(lattice_, e),
         {now_.motion.position[start], now_.motion.position[end], step * now_.spin[start], step * now_.spin[end]},
         &now_.elements[e]});
  }
  const std::vector<ElementForces> forces = advance_unit(lattice_.rule, moved);
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const Segment& segment = lattice_.segments[unit[k]];
    now_.force[segment.start] += forces[k].on_end;  // resistance acts against the motion (Eq. 4)
    now_.force[segment.end] -= forces[k].on_end;
    now_.moment[segment.start] -= forces[k].moment_on_start;
    now_.moment[segment.end] -= forces[k].moment_on_end;
    works_.plastic += forces[k].plastic_work;
  }
}

/// Forces at the time: of the elements over the step before it, of contacts and of plates.
void Crush::evaluate_forces() {
  const std::size_t count = lattice_.position.size();
  now_.force.assign(count, Vector::Zero());
  now_.moment.assign(count, 0.0);
  const double step = time_ == 0.0 ? 0.0 : lattice_.time_step;
  for (const std::vector<int>& wall : lattice_.walls) {
    for (const std::vector<int>& unit : units_of(lattice_.rule, wall)) {
      resist(unit, step);
    }
  }
  const std::vector<Vector> none(count, Vector::Zero());
  contacts_ = {none, none, none};
  push_walls(lattice_, particles_, now_.motion, pairs_, contacts_);
  push_plates(lattice_, particles_, now_.motion, travel_, speed_at(time_ - lattice_.time_step / 2.0), plate_history_,
              contacts_);
  for (std::size_t i = 0; i < count; ++i) {
    now_.force[i] += contacts_.elastic[i] + contacts_.viscous[i] + contacts_.friction[i];
  }
}

/// Velocities half a step after the time (Eq. 4-6, E2).
void Crush::find_next_velocities() {
  const double a = lattice_.mass_damping * lattice_.time_step / 2.0;
  const std::size_t count = lattice_.position.size();
  next_velocity_.resize(count);
  next_spin_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    next_velocity_[i] =
        ((1.0 - a) * now_.motion.velocity[i] + lattice_.time_step * now_.force[i] / particles_.mass[i]) / (1.0 + a);
    if (particles_.inertia[i] > 0.0) {  // it has a rotation (E5b)
      next_spin_[i] =
          ((1.0 - a) * now_.spin[i] + lattice_.time_step * now_.moment[i] / particles_.inertia[i]) / (1.0 + a);
    }
  }
  for (Body& body : bodies_) {
    find_next_velocities_of(body);
  }
}

/// The same of a rigid body (E13). Its particles move along the chords between their positions.
void Crush::find_next_velocities_of(Body& body) {
  const double dt = lattice_.time_step;
  const double a = lattice_.mass_damping * dt / 2.0;
  Vector force = Vector::Zero();
  double moment = 0.0;
  for (int i = body.data.first; i < body.data.end; ++i) {
    force += now_.force[i];
    moment += now_.moment[i] + cross(now_.motion.position[i] - body.centre, now_.force[i]);
  }
  body.next_velocity = ((1.0 - a) * body.velocity + dt * force / body.mass) / (1.0 + a);
  body.next_spin = ((1.0 - a) * body.spin + dt * moment / body.inertia) / (1.0 + a);
  Body next = body;
  next.centre += dt * body.next_velocity;
  next.rotation += dt * body.next_spin;
  for (int i = body.data.first; i < body.data.end; ++i) {
    next_velocity_[i] = (position_in(next, i) - now_.motion.position[i]) / dt;
    next_spin_[i] = body.next_spin;
  }
}

Vector Crush::position_in(const Body& body, std::size_t particle) const {
  const Vector arm = lattice_.position[particle] - body.first_centre;
  return body.centre + std::cos(body.rotation) * arm + std::sin(body.rotation) * turned_left(arm);
}

/// Adds the works of the forces at the time over half a step at given velocities (E10).
void Crush::add_works(const std::vector<Vector>& velocity, const std::vector<double>& spin, double plate_speed) {
  const double half = lattice_.time_step / 2.0;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const Vector displacement = half * velocity[i];
    works_.contact -= contacts_.elastic[i].dot(displacement);
    works_.contact_damping -= contacts_.viscous[i].dot(displacement);
    works_.friction -= contacts_.friction[i].dot(displacement);
    const Vector mean_velocity = (now_.motion.velocity[i] + next_velocity_[i]) / 2.0;  // E2
    const double mean_spin = (now_.spin[i] + next_spin_[i]) / 2.0;
    works_.mass_damping += lattice_.mass_damping * (particles_.mass[i] * mean_velocity.dot(displacement) +
                                                    particles_.inertia[i] * mean_spin * half * spin[i]);
  }
  works_.contact += contacts_.impact_elastic * half * plate_speed;
  works_.contact_damping += contacts_.impact_viscous * half * plate_speed;
  works_.external += (contacts_.impact_elastic + contacts_.impact_viscous) * half * plate_speed;
}

void Crush::advance() {
  const double dt = lattice_.time_step;
  add_works(next_velocity_, next_spin_, speed_at(time_ + dt / 2.0));
  for (Body& body : bodies_) {
    body.velocity = body.next_velocity;
    body.spin = body.next_spin;
    body.centre += dt * body.velocity;
    body.rotation += dt * body.spin;
  }
  for (std::size_t i = 0; i < now_.motion.position.size(); ++i) {
    now_.motion.position[i] += dt * next_velocity_[i];  // Eq. 5, E2
  }
  now_.motion.velocity = next_velocity_;
  now_.spin = next_spin_;
  travel_ += dt * speed_at(time_ + dt / 2.0);
  time_ += dt;
  evaluate_forces();
  find_next_velocities();
  add_works(now_.motion.velocity, now_.spin, speed_at(time_ - dt / 2.0));
}

void Crush::adopt(Instant instant) {
  now_ = std::move(instant);
  find_next_velocities();
}

Energies Crush::energies() const {
  Energies energies = works_;
  for (std::size_t i = 0; i < now_.motion.velocity.size(); ++i) {
    energies.kinetic += 0.5 * (particles_.mass[i] * now_.motion.velocity[i].dot(next_velocity_[i]) +
                               particles_.inertia[i] * now_.spin[i] * next_spin_[i]);
  }
  for (int e = 0; e < lattice_.element_count; ++e) {
    energies.elastic += elastic_energy(lattice_.rule, element_data_of(lattice_, e), now_.elements[e]);
  }
  return energies;
}

}  // namespace cellcrush::reference
