#include <algorithm>

#include "fields/field_checker.h"
#include "push/face_forces.h"
#include "push/push.h"

namespace cellcrush {
namespace {

/// Where a wall is at a time, with its mean speed over the step before.
RigidWallMotion motion_at(const Scene& scene, const RigidWall& wall, double time) {
  const double step = scene.schedule.time_step;
  return {wall.motion.value_at(time), wall.travel_between(time - step, time) / step};
}

void place_walls(const Scene& scene, State& state) {
  const std::size_t n = scene.particle_count();
  if (std::ranges::any_of(scene.rigid_walls, [](const RigidWall& wall) { return wall.friction > 0.0; })) {
    state.friction_force.assign(n, Vector2::Zero());
    state.rigid_wall_friction.assign(scene.rigid_walls.size() * n, 0.0);
  }
  state.rigid_wall_force.resize(scene.rigid_walls.size());
  state.rigid_wall_impulse.resize(scene.rigid_walls.size());
  for (const RigidWall& wall : scene.rigid_walls) {
    state.rigid_wall_motion.push_back(motion_at(scene, wall, 0.0));
  }
}

void move_walls(const Scene& scene, State& state) {
  const double time = static_cast<double>(state.step + 1) * scene.schedule.time_step;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    state.rigid_wall_motion[wall] = motion_at(scene, scene.rigid_walls[wall], time);
  }
}

void press_by_walls(const Scene& scene, State& state, const PlateStep& /*plates*/, const PressedBand& on,
                    ContactSums& sums) {
  const LatticeBand& band = on.band;
  for (const auto& [first, end] : {std::pair(band.first_joint, band.end_joint), {band.first_inner, band.end_inner}}) {
    for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
      press_by_half_plane(scene, state, wall, first, end, sums);
    }
  }
}

/// The works of the newest forces over half of the ways of the walls from one time to another, s: as velocities are at
/// half steps (E10), forces work on half of the steps before and after them. Walls move along their normals, so
/// friction does no work on them.
MotionWorks works_between(const Scene& scene, const State& state, double from, double to) {
  MotionWorks works;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const double half_way = 0.5 * scene.rigid_walls[wall].travel_between(from, to);
    works.add(face_works(state.rigid_wall_force[wall].normal, half_way));
  }
  return works;
}

void accumulate_walls(const Scene& scene, double time, const PlateStep& /*plates*/, State& state) {
  const double step = scene.schedule.time_step;
  works_between(scene, state, time - step, time + step).accumulate(state.ledger);
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const RigidWallForce& force = state.rigid_wall_force[wall];
    state.rigid_wall_impulse[wall].normal += step * force.normal.total();
    state.rigid_wall_impulse[wall].tangential += step * force.tangential;
  }
}

MotionWorks half_step_works_of_walls(const Scene& scene, const State& state) {
  return works_between(scene, state, state.time - scene.schedule.time_step, state.time);
}

std::string words_of_walls(const Scene& scene) {
  const std::size_t count = scene.rigid_walls.size();
  if (count == 0) {
    return "";
  }
  const auto moving =
      std::ranges::count_if(scene.rigid_walls, [](const RigidWall& wall) { return wall.motion.points.size() > 1; });
  const double friction = std::ranges::max(scene.rigid_walls, {}, &RigidWall::friction).friction;
  return "Rigid walls: " + std::to_string(count) + (count == 1 ? " half plane, " : " half planes, ") +
         std::to_string(moving) + " of them moving, unilateral, not meshed, " +
         (friction > 0.0 ? "Coulomb friction, coefficient up to " + to_text(friction) + "." : "frictionless.");
}

}  // namespace

extern const Pusher kRigidWalls = {.place = place_walls,
                                   .move = move_walls,
                                   .press = press_by_walls,
                                   .accumulate = accumulate_walls,
                                   .half_step_works = half_step_works_of_walls,
                                   .words = words_of_walls};

}  // namespace cellcrush
