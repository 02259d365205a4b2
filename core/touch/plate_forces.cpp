#include "touch/plate_forces.h"

#include <limits>

#include "contact/thickening.h"
#include "touch/face_forces.h"

namespace cellcrush {
namespace {

/// A plate at `place` mm along the crush, on the side of the lattice to which `outward` points, +1 or -1 along it.
Face face_of_plate(const Scene& scene, double place, double outward, double velocity, std::vector<double>& friction_of,
                   bool grows) {
  const Plates& plates = scene.plates;
  Face face = {Vector2::Zero(),
               Vector2::Zero(),
               Vector2::Zero(),
               outward * velocity,
               plates.stiffness,
               plates.friction,
               plates.friction > 0.0 ? friction_of.data() : nullptr,
               grows};
  face.point[plates.axis] = place;
  face.normal[plates.axis] = outward;
  face.tangent[1 - plates.axis] = 1.0;
  return face;
}

/// Adds a force to that of a plate, and to the stored energy.
void add_force(const FaceForce& force, PlateForce& plate, double& stored) {
  plate.elastic += force.elastic;
  plate.viscous += force.viscous;
  stored += force.stored;
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
  const double impact_place = plates.impact_face + motion.impact_travel;
  const double support_place = plates.support_face;
  const Face impact = face_of_plate(scene, impact_place, 1.0, motion.impact_speed, state.impact_friction, grows);
  const Face support = face_of_plate(scene, support_place, -1.0, 0.0, state.support_friction, grows);
  // For most lattices; then no radius is loaded from memory.
  const bool is_uniform = scene.smallest_radius == scene.largest_radius;
  for (const int particle : near) {
    const double place = state.position[particle][plates.axis];
    const double radius = is_uniform && !grows ? scene.largest_radius : radius_now(scene, state, particle);
    const bool rubbed = rubs && (impact.friction_of[particle] != 0.0 || support.friction_of[particle] != 0.0);
    if (place - radius < impact_place || place + radius > support_place || rubbed) {
      add_force(push_by_face(scene, state, impact, particle, radius), sums.impact, sums.walls.stored);
      add_force(push_by_face(scene, state, support, particle, radius), sums.support, sums.walls.stored);
    }
  }
}

}  // namespace cellcrush
