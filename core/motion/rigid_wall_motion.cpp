#include "motion/rigid_wall_motion.h"

#include "motion/plate_motion.h"

namespace cellcrush {

MotionWorks rigid_wall_works(const Scene& scene, const State& state, double from, double to) {
  MotionWorks works;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const double half_way = 0.5 * scene.rigid_walls[wall].travel_between(from, to);
    works.add(plate_works(state.rigid_wall_force[wall].normal, half_way));
  }
  return works;
}

void accumulate_rigid_walls(const Scene& scene, double time, State& state) {
  const double step = scene.schedule.time_step;
  rigid_wall_works(scene, state, time - step, time + step).accumulate(state.ledger);
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const RigidWallForce& force = state.rigid_wall_force[wall];
    state.rigid_wall_impulse[wall].normal += step * force.normal.total();
    state.rigid_wall_impulse[wall].tangential += step * force.tangential;
  }
}

}  // namespace cellcrush
