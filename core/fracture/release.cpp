#include "fracture/release.h"

#include "cellcrush/vector.h"

namespace cellcrush {
namespace {

/// What an end and the joint that it has broken off are now.
struct Parted {
  int end;
  int joint;
};

Parted parted_by(const Scene& scene, const State& state, std::size_t k) {
  const auto first = scene.joint_count - static_cast<int>(state.breaks.size());  // of the new ends
  const auto before = static_cast<int>(scene.particle_count() - state.breaks.size());
  const int particle = state.breaks[k].particle;
  return {first + static_cast<int>(k), particle < before ? particle : first + particle - before};
}

Vector2 force_on(const State& state, int particle) {
  Vector2 force =
      state.internal_force[particle] + state.contact_force[particle].elastic + state.contact_force[particle].viscous;
  if (!state.friction_force.empty()) force += state.friction_force[particle];
  if (!state.load_force.empty()) force += state.load_force[particle];
  return force;
}

double moment_on(const State& state, int particle) {
  double moment = state.internal_moment[particle];
  if (!state.contact_moment.empty()) moment += state.contact_moment[particle];
  if (!state.load_moment.empty()) moment += state.load_moment[particle];
  return moment;
}

/// What an end needs from its joint to move as the joint does: `on_end` and `on_joint` act on them, and their inertias
/// are `of_end` and `of_joint`. A joint that is held does not yield to either.
double holding(double on_end, double on_joint, double of_end, double of_joint, bool held) {
  return held || of_end + of_joint == 0.0 ? -on_end : of_end / (of_end + of_joint) * (on_end + on_joint) - on_end;
}

/// The force that holds an end, times a share.
void put_force(const Scene& scene, const State& state, const Parted& parted, double share, Break& of) {
  const auto [end, joint] = parted;
  const Vector2 on_end = force_on(state, end);
  const Vector2 on_joint = force_on(state, joint);
  const bool in_body = joint < scene.rigid.particle_count();
  const Support support = scene.supports.empty() ? Support() : scene.supports[joint];
  const auto hold = [&](int axis, bool held) {
    return share * holding(on_end[axis], on_joint[axis], scene.mass[end], scene.mass[joint], held || in_body);
  };
  of.force = {hold(0, support.x.held), hold(1, support.y.held)};
  const bool turns = scene.inertia[joint] > 0.0 && !support.rotation.held && !in_body;
  of.moment =
      share * holding(moment_on(state, end), moment_on(state, joint), scene.inertia[end], scene.inertia[joint], !turns);
  of.levelling = -0.5 * cross(state.position[end] - state.position[joint], of.force);
}

/// Work against the forces of a break over half a step.
double work_of(const Scene& scene, const State& state, const Parted& parted, const Break& of) {
  const Vector2 parting = state.velocity[parted.end] - state.velocity[parted.joint];
  const double turning = state.spin[parted.end] - state.spin[parted.joint];
  const double together = state.spin[parted.end] + state.spin[parted.joint];
  return -0.5 * scene.schedule.time_step * (of.force.dot(parting) + of.moment * turning + of.levelling * together);
}

}  // namespace

void release_ends(const Scene& scene, State& state) {
  for (std::size_t k = state.breaks.size(); k-- > 0;) {
    Break& of = state.breaks[k];
    const std::int64_t steps = state.step - of.step;
    if (steps > kReleaseSteps) return;
    const Parted parted = parted_by(scene, state, k);
    of.released += work_of(scene, state, parted, of);  // of the forces before
    put_force(scene, state, parted, 1.0 - static_cast<double>(steps) / kReleaseSteps, of);
    of.released += work_of(scene, state, parted, of);
    state.internal_force[parted.end] += of.force;
    state.internal_force[parted.joint] -= of.force;
    state.internal_moment[parted.end] += of.moment + of.levelling;
    state.internal_moment[parted.joint] += of.levelling - of.moment;
  }
}

}  // namespace cellcrush
