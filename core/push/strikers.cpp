// Half planes with a mass, which the lattice, gravity and a force slow down or speed up (E9g), by the central
// differences of the particles (E2).
#include <array>
#include <cmath>

#include "push/half_planes.h"

namespace cellcrush {
namespace {

constexpr std::string_view kForce = "force_n";
constexpr std::string_view kPressure = "pressure_mpa";
constexpr std::string_view kDropHeight = "drop_height_mm";
constexpr std::array<std::string_view, 5> kFields = {"mass_g", "speed_m_per_s", kDropHeight, kForce, kPressure};

bool takes_striker(const LoadsSpec::RigidWall& wall) { return wall.own.contains("mass_g"); }

double own_number(const LoadsSpec::RigidWall& wall, std::string_view name) {
  const auto found = wall.own.find(std::string(name));
  return found == wall.own.end() ? 0.0 : found->second;
}

const LoadsSpec::TimeFunction* function_of(const LoadsSpec::RigidWall& wall, std::string_view name) {
  const auto found = wall.functions.find(std::string(name));
  return found == wall.functions.end() ? nullptr : &found->second;
}

Vector2 normal_of_wall(const LoadsSpec::RigidWall& wall) {
  return wall.edge ? normal_at(*wall.edge) : Vector2(wall.normal_x, wall.normal_y).stableNormalized();
}

void check_drop(const std::string& field, const SceneSpec& spec, const LoadsSpec::RigidWall& wall,
                FieldChecker& check) {
  const double height = own_number(wall, kDropHeight);
  if (height <= 0.0) return;
  if (wall.own.contains("speed_m_per_s")) {
    check.add(field, to_text(height), "is given with speed_m_per_s.", "Give one of them: the height makes the speed.");
  }
  const Vector2 gravity(spec.loads.gravity_x_m_per_s2, spec.loads.gravity_y_m_per_s2);
  if (normal_of_wall(wall).dot(gravity) <= 0.0) {
    check.add(field, to_text(height),
              "is the height of a fall, but gravity does not pull the wall towards the lattice.",
              "Give loading.gravity_y_m_per_s2, -9.81 for a wall at the TOP.");
  }
}

void check_striker(const std::string& path, const SceneSpec& spec, const LoadsSpec::RigidWall& wall,
                   FieldChecker& check) {
  if (!wall.points.empty()) {
    check.add(path + "displacement_mm", "", "is imposed, but a rigid wall with mass_g moves freely.",
              "Remove displacement_mm or mass_g; speed_m_per_s gives the speed of a mass.");
  }
  check_drop(path + std::string(kDropHeight), spec, wall, check);
  if (!wall.functions.contains(std::string(kPressure))) return;
  const std::string field = path + std::string(kPressure);
  if (wall.functions.contains(std::string(kForce))) {
    check.add(field, "", "is given with force_n.", "Give one of them.");
  }
  if (!wall.edge || std::holds_alternative<FrameWalls>(spec.lattice)) {
    check.add(field, "", "needs the cross-section of a lattice at an edge.",
              "Give the edge at which the wall stands; for a frame give force_n.");
  }
}

/// m g h is the energy of the speed at which it comes down.
double speed_of_fall(double height, double gravity) { return std::sqrt(2.0 * height * std::max(0.0, gravity)); }

void fill_striker(const LoadsSpec::RigidWall& from, const WallRoom& room, RigidWall& to) {
  to.mass = own_number(from, "mass_g") * kTonnePerGram;
  to.speed = own_number(from, "speed_m_per_s") * kMmPerM +
             speed_of_fall(own_number(from, kDropHeight), room.gravity.dot(to.normal));
  if (const auto* force = function_of(from, kForce)) to.force.points = *force;
  if (const auto* pressure = function_of(from, kPressure)) {
    for (const auto& [time, value] : *pressure) to.force.points.emplace_back(time, value * room.area);
  }
}

RigidWallMotion start_striker(const Scene& /*scene*/, const RigidWall& wall) { return {0.0, wall.speed}; }

RigidWallMotion move_striker(const Scene& scene, const State& state, std::size_t wall) {
  const double step = scene.schedule.time_step;
  const RigidWallMotion& now = state.rigid_wall_motion[wall];
  const double speed = now.speed + step * acceleration_of(scene, state, wall);
  return {now.travel + step * speed, speed};
}

double drive_striker(const Scene& scene, const RigidWall& wall, double time) {
  const double of_force = wall.force.points.empty() ? 0.0 : wall.force.value_at(time) / wall.mass;
  return scene.gravity.dot(wall.normal) + of_force;
}

}  // namespace

extern const HalfPlaneKind kStrikers = {.plural = "Rigid walls with a mass",
                                        .takes = takes_striker,
                                        .fields = kFields,
                                        .misfit = "is imposed, but a rigid wall with mass_g moves freely.",
                                        .remedy = "Remove it or mass_g; speed_m_per_s gives the speed of a mass.",
                                        .check = check_striker,
                                        .fill = fill_striker,
                                        .start = start_striker,
                                        .move = move_striker,
                                        .drive = drive_striker};

}  // namespace cellcrush
