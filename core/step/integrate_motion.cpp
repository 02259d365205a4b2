#include "step/integrate_motion.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "energy/ledger.h"
#include "step/rigid_motion.h"

namespace cellcrush {

Resultant resultant_on(const Scene& scene, const State& state, std::size_t particle) {
  Resultant sum = {
      state.internal_force[particle] + state.contact_force[particle].elastic + state.contact_force[particle].viscous,
      state.internal_moment[particle]};
  if (!state.friction_force.empty()) {
    sum.force += state.friction_force[particle];
  }
  if (scene.is_loaded()) {
    sum.force += state.load_force[particle];
    sum.moment += state.load_moment[particle];
  }
  return sum;
}

namespace {

/// Velocity that makes a held motion follow its function over the coming step, 0 where it stands.
double held_velocity(const Scene& scene, const State& state, const Hold& hold) {
  if (hold.motion < 0) {
    return 0.0;
  }
  const TimeFunction& motion = scene.motions[hold.motion];
  const double step = scene.schedule.time_step;
  return (motion.value_at(state.time + step) - motion.value_at(state.time)) / step;
}

/// Puts held velocities in place of the free ones and notes the force that it takes.
void apply_support(const Scene& scene, const State& state, const Support& support, double force_per_velocity,
                   double moment_per_spin, NextVelocity& next) {
  const auto put = [&](const Hold& hold, double& velocity, double per_velocity, double& reaction) {
    if (hold.held) {
      const double held = held_velocity(scene, state, hold);
      reaction = per_velocity * (held - velocity);
      velocity = held;
    }
  };
  put(support.x, next.velocity.x(), force_per_velocity, next.reaction.x());
  put(support.y, next.velocity.y(), force_per_velocity, next.reaction.y());
  put(support.rotation, next.spin, moment_per_spin, next.reaction_moment);
}

}  // namespace

DampedStep damped_step_of(const Scene& scene) {
  const double step = scene.schedule.time_step;
  const double damping = 0.5 * scene.mass_damping * step;
  return {(1.0 - damping) / (1.0 + damping), step / (1.0 + damping)};
}

NextVelocity next_velocity(const Scene& scene, const State& state, const DampedStep& damped, std::size_t particle) {
  const Resultant sum = resultant_on(scene, state, particle);
  const auto [keep, gain] = damped;
  NextVelocity next = {keep * state.velocity[particle] + gain * scene.inverse_mass[particle] * sum.force,
                       keep * state.spin[particle] + gain * scene.inverse_inertia[particle] * sum.moment};
  if (!scene.supports.empty()) {
    apply_support(scene, state, scene.supports[particle], scene.mass[particle] / gain, scene.inertia[particle] / gain,
                  next);
  }
  return next;
}

namespace {

/// Fibres without stress that have never flowed.
template <class T>
void place_fibres(const Scene& scene, FibreMemory<T>& fibres) {
  const std::size_t elements = scene.element_count();
  fibres.stress.assign(elements * scene.fibre_count(), T(0.0));
  if (scene.has_hardening()) {
    fibres.back_stress.assign(elements * scene.fibre_count(), T(0.0));
    fibres.plastic_strain.assign(elements * scene.fibre_count(), T(0.0));
  } else {
    fibres.flowed.assign(elements, 0);
  }
  if (scene.section.force_based) {
    fibres.section_unbalance.assign(elements * scene.section.section_count(), T(0.0));
    fibres.section_flexibility.assign(elements * scene.section.section_count(), T(1.0));
    fibres.start_moment.assign(elements, T(0.0));
    fibres.end_moment.assign(elements, T(0.0));
  }
}

}  // namespace

State place_particles(const Scene& scene) {
  const std::size_t n = scene.particle_count();
  State state;
  state.position.assign(scene.position.begin(), scene.position.end());
  state.velocity.assign(scene.initial_velocity.begin(), scene.initial_velocity.end());
  state.velocity.resize(n, Vector2::Zero());
  state.spin.assign(scene.initial_spin.begin(), scene.initial_spin.end());
  state.spin.resize(n, 0.0);
  state.rotation.assign(n, 0.0);
  state.length.reserve(scene.element_count());
  state.inverse_length.reserve(scene.element_count());
  state.axis.reserve(scene.element_count());
  for (const Element& element : scene.elements) {
    const Vector2 span = scene.position[element.end] - scene.position[element.start];
    state.length.push_back(span.norm());
    state.inverse_length.push_back(1.0 / span.norm());
    state.axis.push_back(span / state.length.back());
  }
  scene.single_fibres ? place_fibres(scene, state.single_fibres) : place_fibres(scene, state.fibres);
  state.wall_force.assign(2 * scene.walls.start.size(), Vector2::Zero());
  state.wall_moment.assign(2 * scene.walls.start.size(), 0.0);
  state.internal_force.assign(n, Vector2::Zero());
  state.internal_moment.assign(n, 0.0);
  state.contact_force.assign(n, ContactForce());
  if (scene.contact.friction > 0.0 || scene.plates.friction > 0.0) {
    state.friction_force.assign(n, Vector2::Zero());
  }
  if (scene.plates.friction > 0.0) {
    state.impact_friction.assign(n, 0.0);
    state.support_friction.assign(n, 0.0);
  }
  if (scene.is_loaded()) {
    state.load_force.assign(n, Vector2::Zero());
    state.load_moment.assign(n, 0.0);
  }
  state.contacts.resize(scene.bands.size());
  place_rigid_bodies(scene, state);
  return state;
}

void stagger_velocities(const Scene& scene, State& state) {
  stagger_rigid_bodies(scene, state);
  const DampedStep damped = damped_step_of(scene);
  for (std::size_t i = first_free_particle(scene); i < scene.particle_count(); ++i) {
    const NextVelocity next = next_velocity(scene, state, damped, i);
    state.velocity[i] -= 0.5 * (next.velocity - state.velocity[i]);
    state.spin[i] -= 0.5 * (next.spin - state.spin[i]);
  }
}

namespace {

/// Moves all free particles by a step and books the work of the forces on them.
void move_particles(const Scene& scene, State& state) {
  const double step = scene.schedule.time_step;
  const DampedStep damped = damped_step_of(scene);
  for (std::size_t i = first_free_particle(scene); i < scene.particle_count(); ++i) {
    const NextVelocity next = next_velocity(scene, state, damped, i);
    const MeanMotion mean = {0.5 * step * (state.velocity[i] + next.velocity),
                             0.5 * step * (state.spin[i] + next.spin)};
    accumulate_work(scene, state, i, next, mean, state.ledger);
    state.velocity[i] = next.velocity;
    state.spin[i] = next.spin;
    state.position[i] += step * next.velocity;
    state.rotation[i] += step * next.spin;
    clear_contact_force(state, i);
  }
}

/// What the chunks have noted, moved together behind the rigid bodies' particles, which are few.
NearPlates gather_near_plates(const Scene& scene, MotionWorkspace& workspace) {
  std::vector<int>& near = workspace.near_plates;
  std::size_t count = first_free_particle(scene);
  std::iota(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), 0);
  for (const MovedChunk& chunk : workspace.chunks) {
    std::copy_n(near.begin() + static_cast<std::ptrdiff_t>(chunk.first), chunk.near_count,
                near.begin() + static_cast<std::ptrdiff_t>(count));
    count += chunk.near_count;
  }
  return std::span<const int>(near.data(), count);
}

}  // namespace

PlateStep plate_step_of(const Scene& scene, double time, double travel) {
  const double step = scene.schedule.time_step;
  const double speed_before = scene.plates.speed_at(time - 0.5 * step);
  const double speed_after = scene.plates.speed_at(time + 0.5 * step);
  return {0.5 * step * (speed_before + speed_after), travel + step * speed_after};
}

void book_plates(const Scene& scene, const PlateStep& plates, State& state) {
  const double step = scene.schedule.time_step;
  accumulate_plate_work(state, plates.displacement, state.ledger);
  state.impact_impulse += step * state.impact_force.total();
  state.support_impulse += step * state.support_force.total();
  state.impact_travel = plates.travel;
}

NearPlates integrate_motion(const Scene& scene, State& state, MotionWorkspace& workspace, Workers& workers) {
  const double step = scene.schedule.time_step;
  const PlateStep plates = plate_step_of(scene, state.time, state.impact_travel);
  move_rigid_bodies(scene, state);
  NearPlates near;
  if (have_wide_motion(scene)) {
    const PlateReach reach = reach_of_plates(scene, plates.travel);
    move_particles_wide(scene, state, reach, workspace, workers);
    near = gather_near_plates(scene, workspace);
  } else {
    move_particles(scene, state);
  }
  book_plates(scene, plates, state);
  ++state.step;
  state.time = static_cast<double>(state.step) * step;
  return near;
}

}  // namespace cellcrush
