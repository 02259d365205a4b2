// Half planes that stand still or move as prescribed, whatever the lattice does (E9f): by a displacement, or by a
// velocity over time.
#include <algorithm>
#include <array>
#include <cmath>

#include "push/half_planes.h"

namespace cellcrush {
namespace {

constexpr std::array<std::string_view, 1> kVelocity = {"velocity_m_per_s"};
constexpr std::string_view kNeedsMass = "is that of a rigid wall with a mass, but mass_g is missing.";
constexpr std::string_view kGiveMass =
    "Give mass_g too, or the motion of the wall as displacement_mm or velocity_m_per_s.";

/// Where a wall is at a time, with its mean speed over the step before.
RigidWallMotion motion_at(const Scene& scene, const RigidWall& wall, double time) {
  const double step = scene.schedule.time_step;
  return {wall.motion.value_at(time), wall.travel_between(time - step, time) / step};
}

bool takes_any(const LoadsSpec::RigidWall& /*wall*/) { return true; }

RigidWallMotion start_wall(const Scene& scene, const RigidWall& wall) { return motion_at(scene, wall, 0.0); }

RigidWallMotion move_wall(const Scene& scene, const State& state, std::size_t wall) {
  return motion_at(scene, scene.rigid_walls[wall], static_cast<double>(state.step + 1) * scene.schedule.time_step);
}

bool takes_paced(const LoadsSpec::RigidWall& wall) { return wall.functions.contains(std::string(kVelocity[0])); }

void check_paced(const std::string& path, const SceneSpec& /*spec*/, const LoadsSpec::RigidWall& wall,
                 FieldChecker& check) {
  constexpr double kFastest = 1000.0;  // m/s
  const std::string field = path + std::string(kVelocity[0]);
  for (const auto& [time, speed] : wall.functions.at(std::string(kVelocity[0]))) {
    if (std::abs(speed) > kFastest) {
      check.add(field, to_text(speed), "is faster than the solver is meant for.", "Give at most 1000 m/s.");
      break;
    }
  }
  if (!wall.points.empty()) {
    check.add(field, "", "is given with displacement_mm.", "Give one of them.");
  }
}

void fill_paced(const LoadsSpec::RigidWall& from, const WallRoom& /*room*/, RigidWall& to) {
  for (const auto& [time, speed] : from.functions.at(std::string(kVelocity[0]))) {
    to.velocity.points.emplace_back(time, speed * kMmPerM);
  }
  to.motion = to.velocity.integral();
}

/// The speed half a step before, as a particle has it.
RigidWallMotion start_paced(const Scene& scene, const RigidWall& wall) {
  return {0.0, wall.velocity.value_at(-0.5 * scene.schedule.time_step)};
}

RigidWallMotion move_paced(const Scene& scene, const State& state, std::size_t wall) {
  const double step = scene.schedule.time_step;
  const double speed = scene.rigid_walls[wall].velocity.value_at((static_cast<double>(state.step) + 0.5) * step);
  return {state.rigid_wall_motion[wall].travel + step * speed, speed};
}

}  // namespace

extern const HalfPlaneKind kPacedWalls = {.plural = "Rigid walls at a given velocity",
                                          .takes = takes_paced,
                                          .fields = kVelocity,
                                          .misfit = kNeedsMass,
                                          .remedy = kGiveMass,
                                          .check = check_paced,
                                          .fill = fill_paced,
                                          .start = start_paced,
                                          .move = move_paced};

extern const HalfPlaneKind kRigidWalls = {.plural = "Rigid walls",
                                          .takes = takes_any,
                                          .fields = {},
                                          .misfit = kNeedsMass,
                                          .remedy = kGiveMass,
                                          .check = nullptr,
                                          .fill = nullptr,
                                          .start = start_wall,
                                          .move = move_wall};

}  // namespace cellcrush
