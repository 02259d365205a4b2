// Half planes that stand still or move as prescribed, whatever the lattice does (E9f).
#include "push/half_planes.h"

namespace cellcrush {

extern const Pusher kRigidWalls;

namespace {

/// Where a wall is at a time, with its mean speed over the step before.
RigidWallMotion motion_at(const Scene& scene, const RigidWall& wall, double time) {
  const double step = scene.schedule.time_step;
  return {wall.motion.value_at(time), wall.travel_between(time - step, time) / step};
}

void put_walls(const Scene& scene, State& state, double time) {
  visit_half_planes(scene, kRigidWalls, [&](std::size_t index, const RigidWall& wall) {
    state.rigid_wall_motion[index] = motion_at(scene, wall, time);
  });
}

/// The works of the newest forces over half of the ways of the walls from one time to another, s: as velocities are at
/// half steps (E10), forces work on half of the steps before and after them. Walls move along their normals, so
/// friction does no work on them.
MotionWorks works_between(const Scene& scene, const State& state, double from, double to) {
  MotionWorks works;
  visit_half_planes(scene, kRigidWalls, [&](std::size_t index, const RigidWall& wall) {
    works.add(face_works(state.rigid_wall_force[index].normal, 0.5 * wall.travel_between(from, to)));
  });
  return works;
}

bool takes_wall(const LoadsSpec::RigidWall& /*any*/) { return true; }

void check_wall(const std::string& path, const LoadsSpec::RigidWall& wall, FieldChecker& check) {
  for (const auto& [name, value] : wall.own) {
    check.add(path + name, to_text(value), "is that of a rigid wall with a mass, but mass_g is missing.",
              "Give mass_g too, or the motion of the wall as displacement_mm.");
  }
}

void place_walls(const Scene& scene, State& state) {
  place_half_planes(scene, state);
  put_walls(scene, state, 0.0);
}

void move_walls(const Scene& scene, State& state) {
  put_walls(scene, state, static_cast<double>(state.step + 1) * scene.schedule.time_step);
}

void press_by_walls(const Scene& scene, State& state, const PlateStep& /*plates*/, const PressedBand& on,
                    ContactSums& sums) {
  press_half_planes(scene, state, kRigidWalls, on, sums);
}

void accumulate_walls(const Scene& scene, double time, const PlateStep& /*plates*/, State& state) {
  const double step = scene.schedule.time_step;
  works_between(scene, state, time - step, time + step).accumulate(state.ledger);
  visit_half_planes(scene, kRigidWalls, [&](std::size_t index, const RigidWall&) { add_impulse(scene, state, index); });
}

MotionWorks half_step_works_of_walls(const Scene& scene, const State& state) {
  return works_between(scene, state, state.time - scene.schedule.time_step, state.time);
}

std::string words_of_walls(const Scene& scene) {
  const std::string count = count_words(scene, kRigidWalls);
  int moving = 0;
  visit_half_planes(scene, kRigidWalls,
                    [&](std::size_t, const RigidWall& wall) { moving += wall.motion.points.size() > 1 ? 1 : 0; });
  return count.empty() ? ""
                       : "Rigid walls: " + count + ", " + std::to_string(moving) + " of them moving, " +
                             friction_words(scene, kRigidWalls);
}

}  // namespace

extern const Pusher kRigidWalls = {.place = place_walls,
                                   .move = move_walls,
                                   .press = press_by_walls,
                                   .accumulate = accumulate_walls,
                                   .half_step_works = half_step_works_of_walls,
                                   .words = words_of_walls,
                                   .takes = takes_wall,
                                   .check = check_wall};

}  // namespace cellcrush
