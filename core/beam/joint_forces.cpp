#include "beam/joint_forces.h"

namespace cellcrush {

void sum_joint_forces(const Scene& scene, State& state, std::size_t first, std::size_t end) {
  const Vector2* forces = state.wall_force.data();
  const double* moments = state.wall_moment.data();
  for (std::size_t joint = first; joint < end; ++joint) {
    const int* ends = &scene.wall_ends[scene.wall_end_offset[joint]];
    const int count = scene.wall_end_offset[joint + 1] - scene.wall_end_offset[joint];
    Vector2 force = Vector2::Zero();
    double moment = 0.0;
    // Most joints of a honeycomb have three: without a loop they take half of the time.
    if (count == 3) {
      force = forces[ends[0]] + forces[ends[1]] + forces[ends[2]];
      moment = moments[ends[0]] + moments[ends[1]] + moments[ends[2]];
    } else {
      for (int k = 0; k < count; ++k) {
        force += forces[ends[k]];
        moment += moments[ends[k]];
      }
    }
    state.internal_force[joint] = force;
    state.internal_moment[joint] = moment;
  }
}

}  // namespace cellcrush
