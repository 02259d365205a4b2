#include "touch/plate_forces.h"

#include <algorithm>
#include <limits>

#include "geometry/thickening.h"
#include "touch/contact_tiles.h"
#include "touch/force_laws.h"
#include "touch/rubbed_surface.h"
#include "touch/thickening_forces.h"

namespace cellcrush {
namespace {

/// One of the two plates at the current time.
struct Plate {
  double face;       ///< mm
  double velocity;   ///< mm/s
  double outward;    ///< +1 or -1: direction from its face into the lattice, along the crush
  PlateForce& sum;   ///< sum of its forces on all particles
  double& stored;    ///< stored energy of all contacts, N mm
  double* friction;  ///< friction of each particle; null without friction
  bool grows;        ///< balls may have grown (E5f)
};

/// Friction of a plate on one particle whose centre is `distance` mm from the face, at most `limit` N. The plates do
/// not move across the crush, so the slip is the motion of the ball's surface in that direction (E9d).
void rub(const Scene& scene, State& state, const Plate& plate, int particle, double distance, double limit) {
  const int across = 1 - scene.plates.axis;
  const double side = scene.plates.axis == 0 ? -plate.outward : plate.outward;  // of a turn that moves it across
  const RubbedSurface surface = {elements_at(scene, particle), distance};
  const double speed = state.velocity[particle][across] + side * speed_by_turning(scene, state, surface);
  const double stiffness = scene.plates.stiffness / std::max(1.0, stiffening(state, surface));
  double& friction = plate.friction[particle];
  friction = evaluate_friction(friction, stiffness, scene.schedule.time_step * speed, limit);
  state.friction_force[particle][across] += friction;
  add_couple(scene, state, surface, side * friction);
}

/// Pushes one particle (E9c).
void push(const Scene& scene, State& state, const Plate& plate, int particle, double radius) {
  const int axis = scene.plates.axis;
  const double distance = plate.outward * (state.position[particle][axis] - plate.face);
  const double depth = radius - distance;
  NormalForce force = {0.0, 0.0};
  if (depth > 0.0) {
    const double rate = plate.outward * (plate.velocity - state.velocity[particle][axis]);
    force = evaluate_normal_force(scene.plates.stiffness, scene.contact.damping_ratio, scene.inverse_mass[particle],
                                  depth, rate);
    plate.stored += 0.5 * force.elastic * depth;
    if (plate.grows && state.radius_growth[particle] > 0.0) {
      push_elements_apart(scene, state, particle, force.elastic);
    }
    state.contact_force[particle].elastic[axis] += plate.outward * force.elastic;
    state.contact_force[particle].viscous[axis] += plate.outward * force.viscous;
    mark_contact_tile(state, particle);
    plate.sum.elastic += force.elastic;
    plate.sum.viscous += force.viscous;
  }
  if (plate.friction != nullptr && (depth > 0.0 || plate.friction[particle] != 0.0)) {
    rub(scene, state, plate, particle, distance, scene.plates.friction * (force.elastic + force.viscous));
  }
}

}  // namespace

PlateReach reach_of_plates(const Scene& scene, double impact_travel) {
  if (!scene.plates.present) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    return {-kFar, kFar};
  }
  constexpr double kRounding = 1e-9;  // mm
  const double reach = scene.greatest_radius() + kRounding;
  return {scene.plates.impact_face + impact_travel + reach, scene.plates.support_face - reach};
}

void evaluate_plate_forces(const Scene& scene, State& state, const PlateMotion& motion, std::span<const int> near,
                           ContactSums& sums) {
  const Plates& plates = scene.plates;
  if (!plates.present) {
    return;
  }
  const bool rubs = plates.friction > 0.0;
  const bool grows = !state.radius_growth.empty();
  double& stored = sums.walls.stored;
  const Plate impact = {plates.impact_face + motion.impact_travel,
                        motion.impact_speed,
                        1.0,
                        sums.impact,
                        stored,
                        rubs ? state.impact_friction.data() : nullptr,
                        grows};
  const Plate support = {
      plates.support_face, 0.0, -1.0, sums.support, stored, rubs ? state.support_friction.data() : nullptr, grows};
  // For most lattices; then no radius is loaded from memory.
  const bool is_uniform = scene.smallest_radius == scene.largest_radius;
  for (const int particle : near) {
    const double place = state.position[particle][plates.axis];
    const double radius = is_uniform && !grows ? scene.largest_radius : radius_now(scene, state, particle);
    const bool rubbed = rubs && (impact.friction[particle] != 0.0 || support.friction[particle] != 0.0);
    if (place - radius < impact.face || place + radius > support.face || rubbed) {
      push(scene, state, impact, particle, radius);
      push(scene, state, support, particle, radius);
    }
  }
}

}  // namespace cellcrush
