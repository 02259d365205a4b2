#include "core/reference/reference_plates.h"

#include <algorithm>
#include <utility>

#include "core/reference/reference_penalty.h"
#include "core/reference/reference_rim.h"

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

}  // namespace cellcrush::reference
