#include <algorithm>
#include <cmath>
#include <string>

#include "contact/thickening.h"
#include "fields/field_checker.h"
#include "push/half_planes.h"

namespace cellcrush {
namespace {

/// Adds a force to that of a plate, and to the stored energy.
void add_force(const FaceForce& force, PlateForce& plate, double& stored) {
  plate.elastic += force.elastic;
  plate.viscous += force.viscous;
  stored += force.stored;
}

void place_plates(const Scene& scene, State& state) {
  if (scene.plates.kinetic_share > 0.0) {
    state.plate_drive = {{-0.5 * scene.schedule.time_step, kStartOfControl * scene.plates.speed, 0.0}};
  }
  if (scene.plates.friction > 0.0) {
    const std::size_t n = scene.particle_count();
    state.friction_force.assign(n, Vector2::Zero());
    state.impact_friction.assign(n, 0.0);
    state.support_friction.assign(n, 0.0);
  }
}

/// Forces are positive in compression: the impact plate pushes along the crush, the support plate against it. Friction
/// acts across the crush on the surfaces of the balls (E9d). Only particles near a plate are tested.
void press_by_plates(const Scene& scene, State& state, const PlateStep& motion, const PressedBand& on,
                     ContactSums& sums) {
  const Plates& plates = scene.plates;
  if (!plates.present) {
    return;
  }
  const bool rubs = plates.friction > 0.0;
  const bool grows = !state.radius_growth.empty();
  const double impact_place = plates.impact_face + motion.travel;
  const double support_place = plates.support_face;
  const Face impact = face_of_plate(scene, impact_place, 1.0, motion.speed, state.impact_friction.data(), grows);
  const Face support = face_of_plate(scene, support_place, -1.0, 0.0, state.support_friction.data(), grows);
  // For most lattices; then no radius is loaded from memory.
  const bool is_uniform = scene.smallest_radius == scene.largest_radius;
  for (const std::span<const int> near : {on.near_joints, on.near_inner}) {
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
}

void accumulate_plates(const Scene& scene, const PlateStep& plates, State& state) {
  const double step = scene.schedule.time_step;
  face_works(state.impact_force, plates.displacement).accumulate(state.ledger);
  state.impact_impulse += step * state.impact_force.total();
  state.support_impulse += step * state.support_force.total();
  state.impact_travel = plates.travel;
}

MotionWorks half_step_works_of_plates(const Scene& scene, const State& state) {
  const double half = 0.5 * scene.schedule.time_step;
  return face_works(state.impact_force, half * plate_speed_at(scene, state, state.time - half));
}

void describe_plates(const Scene& scene, std::vector<std::string>& lines) {
  const Plates& plates = scene.plates;
  if (plates.kinetic_share > 0.0) {
    lines.push_back("Speed: quasi-static, at most " + to_text(std::round(plates.speed) / kMmPerM) +
                    " m/s, and slower where the kinetic energy comes near " +
                    to_text(std::round(1e5 * plates.kinetic_share) / 1e3) +
                    " % of the work done. The run takes about " + std::to_string(scene.schedule.step_count) +
                    " steps, and at most four times as many. Masses are real: scaled ones would need as many steps.");
  }
  if (plates.present) {
    lines.push_back("Plates: rigid, unilateral, not meshed, " + friction_words(plates.friction));
  }
}

}  // namespace

extern const Pusher kPlates = {.place = place_plates,
                               .press = press_by_plates,
                               .accumulate = accumulate_plates,
                               .half_step_works = half_step_works_of_plates,
                               .describe = describe_plates};

Face face_of_plate(const Scene& scene, double place, double outward, double velocity, double* friction_of, bool grows) {
  const Plates& plates = scene.plates;
  Face face = {Vector2::Zero(),
               Vector2::Zero(),
               Vector2::Zero(),
               outward * velocity,
               plates.stiffness,
               plates.friction,
               plates.friction > 0.0 ? friction_of : nullptr,
               grows};
  face.point[plates.axis] = place;
  face.normal[plates.axis] = outward;
  face.tangent[1 - plates.axis] = 1.0;
  return face;
}

PlateStep plate_step_of(const Scene& scene, const State& state, double time, double travel) {
  const double step = scene.schedule.time_step;
  const double before = plate_speed_at(scene, state, time - 0.5 * step);
  const double after = plate_speed_at(scene, state, time + 0.5 * step);
  PlateStep plates = {0.5 * step * (before + after), travel + step * after, after, {}};
  if (scene.plates.present) {
    constexpr double kRounding = 1e-9;  // mm
    const double reach = scene.greatest_radius() + kRounding;
    plates.reach = {scene.plates.impact_face + plates.travel + reach, scene.plates.support_face - reach};
  }
  return plates;
}

}  // namespace cellcrush
