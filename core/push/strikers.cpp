// Half planes with a mass, which only the lattice and gravity slow down or speed up (E9g). F is the force of the face on
// the lattice along the normal n:
//   m dV/dt = m g . n - F
// by the central differences of the particles (E2), without mass damping.
#include "push/half_planes.h"

namespace cellcrush {

extern const Pusher kStrikers;

namespace {

/// Along the normal, mm/s^2, by the newest forces.
double acceleration_of(const Scene& scene, const State& state, std::size_t index) {
  const RigidWall& wall = scene.rigid_walls[index];
  return scene.gravity.dot(wall.normal) - state.rigid_wall_force[index].normal.total() / wall.mass;
}

/// The works of the newest forces over a way along the normal, mm. The mass is part of what the ledger has: of the
/// forces on it, gravity alone comes from outside.
MotionWorks works_over(const Scene& scene, const State& state, std::size_t index, double way) {
  const RigidWall& wall = scene.rigid_walls[index];
  MotionWorks works = face_works(state.rigid_wall_force[index].normal, way);
  works.external = wall.mass * scene.gravity.dot(wall.normal) * way;
  return works;
}

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

void place_strikers(const Scene& scene, State& state) {
  place_half_planes(scene, state);
  visit_half_planes(scene, kStrikers, [&](std::size_t index, const RigidWall& wall) {
    state.rigid_wall_motion[index].speed = wall.speed;
  });
}

void stagger_strikers(const Scene& scene, State& state) {
  visit_half_planes(scene, kStrikers, [&](std::size_t index, const RigidWall&) {
    state.rigid_wall_motion[index].speed -= 0.5 * scene.schedule.time_step * acceleration_of(scene, state, index);
  });
}

void move_strikers(const Scene& scene, State& state) {
  const double step = scene.schedule.time_step;
  visit_half_planes(scene, kStrikers, [&](std::size_t index, const RigidWall&) {
    RigidWallMotion& motion = state.rigid_wall_motion[index];
    motion.speed += step * acceleration_of(scene, state, index);
    motion.travel += step * motion.speed;
  });
}

void press_by_strikers(const Scene& scene, State& state, const PlateStep& /*plates*/, const PressedBand& on,
                       ContactSums& sums) {
  press_half_planes(scene, state, kStrikers, on, sums);
}

void accumulate_strikers(const Scene& scene, double /*time*/, const PlateStep& /*plates*/, State& state) {
  const double step = scene.schedule.time_step;
  visit_half_planes(scene, kStrikers, [&](std::size_t index, const RigidWall&) {
    const double mean = state.rigid_wall_motion[index].speed - 0.5 * step * acceleration_of(scene, state, index);
    works_over(scene, state, index, step * mean).accumulate(state.ledger);
    add_impulse(scene, state, index);
  });
}

MotionWorks half_step_works_of_strikers(const Scene& scene, const State& state) {
  const double step = scene.schedule.time_step;
  MotionWorks works;
  visit_half_planes(scene, kStrikers, [&](std::size_t index, const RigidWall& wall) {
    const double speed = state.rigid_wall_motion[index].speed;
    works.add(works_over(scene, state, index, 0.5 * step * speed));
    works.twice_kinetic += wall.mass * speed * (speed + step * acceleration_of(scene, state, index));
  });
  return works;
}

std::string words_of_strikers(const Scene& scene) {
  const std::string count = count_words(scene, kStrikers);
  return count.empty()
             ? ""
             : "Rigid walls with a mass: " + count + ", free along the normal, " + friction_words(scene, kStrikers);
}

}  // namespace

extern const Pusher kStrikers = {.place = place_strikers,
                                 .stagger = stagger_strikers,
                                 .move = move_strikers,
                                 .press = press_by_strikers,
                                 .accumulate = accumulate_strikers,
                                 .half_step_works = half_step_works_of_strikers,
                                 .words = words_of_strikers,
                                 .takes = takes_striker,
                                 .check = check_striker,
                                 .fill = fill_striker};

}  // namespace cellcrush
