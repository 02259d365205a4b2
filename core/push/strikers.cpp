// Half planes with a mass, which only the lattice and gravity slow down or speed up (E9g), by the central differences
// of the particles (E2).
#include "push/half_planes.h"

namespace cellcrush {
namespace {

bool takes_striker(const LoadsSpec::RigidWall& wall) { return wall.own.contains("mass_g"); }

void check_striker(const std::string& path, const LoadsSpec::RigidWall& wall, FieldChecker& check) {
  for (const auto& [name, value] : wall.own) {
    check.within_limits(path + name, value);
  }
  if (!wall.points.empty()) {
    check.add(path + "displacement_mm", "", "is imposed, but a rigid wall with mass_g moves freely.",
              "Remove displacement_mm or mass_g; speed_m_per_s gives the speed of a mass.");
  }
}

void fill_striker(const LoadsSpec::RigidWall& from, RigidWall& to) {
  const auto speed = from.own.find("speed_m_per_s");
  to.mass = from.own.at("mass_g") * kTonnePerGram;
  to.speed = speed == from.own.end() ? 0.0 : speed->second * kMmPerM;
}

RigidWallMotion start_striker(const Scene& /*scene*/, const RigidWall& wall) { return {0.0, wall.speed}; }

RigidWallMotion move_striker(const Scene& scene, const State& state, std::size_t wall) {
  const double step = scene.schedule.time_step;
  const RigidWallMotion& now = state.rigid_wall_motion[wall];
  const double speed = now.speed + step * acceleration_of(scene, state, wall);
  return {now.travel + step * speed, speed};
}

double fall_striker(const Scene& scene, const RigidWall& wall, const RigidWallMotion& /*motion*/) {
  return scene.gravity.dot(wall.normal);
}

}  // namespace

extern const HalfPlaneKind kStrikers = {
    "Rigid walls with a mass", takes_striker, check_striker, fill_striker, start_striker, move_striker, fall_striker};

}  // namespace cellcrush
