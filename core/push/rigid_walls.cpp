// Half planes that stand still or move as prescribed, whatever the lattice does (E9f).
#include "push/half_planes.h"

namespace cellcrush {
namespace {

/// Where a wall is at a time, with its mean speed over the step before.
RigidWallMotion motion_at(const Scene& scene, const RigidWall& wall, double time) {
  const double step = scene.schedule.time_step;
  return {wall.motion.value_at(time), wall.travel_between(time - step, time) / step};
}

bool takes_any(const LoadsSpec::RigidWall& /*wall*/) { return true; }

void check_wall(const std::string& path, const LoadsSpec::RigidWall& wall, FieldChecker& check) {
  for (const auto& [name, value] : wall.own) {
    check.add(path + name, to_text(value), "is that of a rigid wall with a mass, but mass_g is missing.",
              "Give mass_g too, or the motion of the wall as displacement_mm.");
  }
}

RigidWallMotion start_wall(const Scene& scene, const RigidWall& wall) { return motion_at(scene, wall, 0.0); }

RigidWallMotion move_wall(const Scene& scene, const State& state, std::size_t wall) {
  return motion_at(scene, scene.rigid_walls[wall], static_cast<double>(state.step + 1) * scene.schedule.time_step);
}

}  // namespace

extern const HalfPlaneKind kRigidWalls = {"Rigid walls", takes_any, check_wall, nullptr, start_wall, move_wall};

}  // namespace cellcrush
