#include "beam/joint_forces.h"

namespace cellcrush {

void sum_joint_forces(const Scene& scene, State& state, std::size_t first, std::size_t end) {
  // Raw pointers: a store may alias a vector's own pointer.
  const int* const offsets = scene.wall_end_offset.data();
  const int* const wall_ends = scene.wall_ends.data();
  const Vector2* const forces = state.wall_force.data();
  const double* const moments = state.wall_moment.data();
  Vector2* const sums = state.internal_force.data();
  double* const sums_of_moments = state.internal_moment.data();
  for (std::size_t joint = first; joint < end; ++joint) {
    const int* ends = wall_ends + offsets[joint];
    const int count = offsets[joint + 1] - offsets[joint];
    Vector2 force = Vector2::Zero();
    double moment = 0.0;
    // Most joints of a honeycomb have three walls. Without a loop these take half of the time.
    if (count == 3) {
      force = forces[ends[0]] + forces[ends[1]] + forces[ends[2]];
      moment = moments[ends[0]] + moments[ends[1]] + moments[ends[2]];
    } else {
      for (int k = 0; k < count; ++k) {
        force += forces[ends[k]];
        moment += moments[ends[k]];
      }
    }
    sums[joint] = force;
    sums_of_moments[joint] = moment;
  }
}

void sum_joint_forces(const Scene& scene, State& state, Workers& workers) {
  workers.parallel_for(static_cast<std::size_t>(scene.joint_count),
                       [&](std::size_t first, std::size_t end) { sum_joint_forces(scene, state, first, end); });
}

}  // namespace cellcrush
