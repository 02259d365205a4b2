#include "motion/rigid_motion.h"

#include <cmath>

#include "motion/motion_works-inl.h"
#include "motion/particle_motion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush {
namespace {

using namespace HWY_NAMESPACE;

// Bodies are few: the equations of particles are used at width 1.
using One = hn::CappedTag<double, 1>;

Points<One> to_lane(const Vector2& vector) { return {vector.x(), vector.y()}; }
Vector2 to_vector(const Points<One>& lane) { return {hn::GetLane(lane.x.raw), hn::GetLane(lane.y.raw)}; }
double to_number(Lane<One> lane) { return hn::GetLane(lane.raw); }

/// Motion of a body or of a particle in it.
using Motion = ParticleMotion<One>;

template <class Kinds>
Motion motion_of_body(const ParticleArrays<const State>& arrays, const StepFactors& step, std::size_t body) {
  const State& state = arrays.state;
  const RigidBodies& rigid = arrays.scene.rigid;
  Points<One> force = {0, 0};
  Lane<One> moment = 0;
  for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
    const ParticleForces<One> on_particle = forces_on<true, Kinds, One>(arrays, i);
    const Points<One> arm = to_lane(state.position[i] - state.rigid_centre[body]);
    force = force + on_particle.total;
    moment += on_particle.moment + cross(arm, on_particle.total);
  }
  Motion motion;
  motion.velocity = to_lane(state.rigid_velocity[body]);
  motion.spin = state.rigid_spin[body];
  motion.next = next_velocity<One>(step, motion.velocity, step.gain / rigid.mass[body], force);
  motion.next_spin = next_velocity<One>(step, motion.spin, step.gain / rigid.inertia[body], moment);
  return motion;
}

/// Calls visit(body, its motion, kinds of forces) for every body.
template <class Visit>
void visit_bodies(const Scene& scene, const State& state, const Visit& visit) {
  const ParticleArrays<const State> arrays(scene, state);
  const StepFactors step = step_factors_of(scene);
  with_force_kinds(scene, state, [&](auto kinds) {
    for (std::size_t body = 0; body < scene.rigid.count(); ++body) {
      visit(body, motion_of_body<decltype(kinds)>(arrays, step, body), kinds);
    }
  });
}

/// Motion of a particle of a body that has the velocity `next` over the coming step.
Motion motion_of_particle(const State& state, std::size_t i, const Points<One>& next, const Motion& of_body) {
  Motion motion;
  motion.velocity = to_lane(state.velocity[i]);
  motion.spin = state.spin[i];
  motion.next = next;
  motion.next_spin = of_body.next_spin;
  return motion;
}

/// Velocity over the coming step of a particle of a body that moves by `of_body`.
Points<One> velocity_in_body(const State& state, std::size_t body, std::size_t i, const Motion& of_body) {
  return of_body.next + of_body.next_spin * to_lane(normal_of(state.position[i] - state.rigid_centre[body]));
}

/// Sums the works that visit(tag, particle, works) adds for every particle of a body.
template <class Visit>
MotionWorks sum_works_of_body(const Scene& scene, std::size_t body, const Visit& visit) {
  return sum_works<1>(scene.rigid.offset[body], scene.rigid.offset[body + 1], visit);
}

void turn_axes(const Scene& scene, State& state) {
  for (std::size_t e = scene.rigid.first_element; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    state.axis[e] = (state.position[element.end] - state.position[element.start]) * state.inverse_length[e];
  }
}

}  // namespace

void start_rigid_bodies(const Scene& scene, State& state) {
  const RigidBodies& rigid = scene.rigid;
  for (std::size_t body = 0; body < rigid.count() && !scene.initial_velocity.empty(); ++body) {
    Vector2 momentum = Vector2::Zero();
    double angular = 0.0;
    for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
      const Vector2 of_particle = scene.mass[i] * scene.initial_velocity[i];
      momentum += of_particle;
      angular += cross(Vector2(scene.position[i] - rigid.centre[body]), of_particle) +
                 scene.inertia[i] * scene.initial_spin[i];
    }
    state.rigid_velocity[body] = momentum / rigid.mass[body];
    state.rigid_spin[body] = angular / rigid.inertia[body];
  }
}

void stagger_rigid_bodies(const Scene& scene, State& state) {
  visit_bodies(scene, state, [&](std::size_t body, const Motion& motion, auto) {
    state.rigid_velocity[body] -= 0.5 * (to_vector(motion.next) - state.rigid_velocity[body]);
    state.rigid_spin[body] -= 0.5 * (to_number(motion.next_spin) - state.rigid_spin[body]);
    Motion staggered = motion;
    staggered.next = to_lane(state.rigid_velocity[body]);
    staggered.next_spin = state.rigid_spin[body];
    for (int i = scene.rigid.offset[body]; i < scene.rigid.offset[body + 1]; ++i) {
      state.velocity[i] = to_vector(velocity_in_body(state, body, i, staggered));
      state.spin[i] = state.rigid_spin[body];
    }
  });
}

MotionWorks move_rigid_bodies(const Scene& scene, State& state) {
  MotionWorks sum;
  const StepFactors step = step_factors_of(scene);
  const ParticleArrays<State> arrays(scene, state);
  visit_bodies(scene, state, [&](std::size_t body, const Motion& motion, auto kinds) {
    using Kinds = decltype(kinds);
    state.rigid_velocity[body] = to_vector(motion.next);
    state.rigid_spin[body] = to_number(motion.next_spin);
    state.rigid_centre[body] += step.step * state.rigid_velocity[body];
    state.rigid_rotation[body] += step.step * state.rigid_spin[body];
    const double cosine = std::cos(state.rigid_rotation[body]);
    const double sine = std::sin(state.rigid_rotation[body]);
    sum.add(sum_works_of_body(scene, body, [&](auto, std::size_t i, LaneWorks<One>& works) {
      const Vector2 arm = scene.position[i] - scene.rigid.centre[body];
      const Vector2 place = state.rigid_centre[body] + cosine * arm + sine * normal_of(arm);
      // The velocity is the chord of the step, so that works and contacts agree with the displacement.
      const Points<One> chord = to_lane((place - state.position[i]) / step.step);
      const Motion of_particle = motion_of_particle(state, i, chord, motion);
      add_works_of_step<true, Kinds>(arrays, step, i, forces_on<true, Kinds, One>(arrays, i), of_particle, works);
      state.velocity[i] = to_vector(of_particle.next);
      state.spin[i] = to_number(of_particle.next_spin);
      state.position[i] = place;
      state.rotation[i] = state.rigid_rotation[body];
    }));
  });
  if (scene.rigid.count() > 0) {
    turn_axes(scene, state);
  }
  return sum;
}

MotionWorks half_step_works_of_rigid_bodies(const Scene& scene, const State& state) {
  MotionWorks sum;
  double twice_kinetic = 0.0;
  const StepFactors step = step_factors_of(scene);
  const ParticleArrays<const State> arrays(scene, state);
  visit_bodies(scene, state, [&](std::size_t body, const Motion& motion, auto kinds) {
    using Kinds = decltype(kinds);
    sum.add(sum_works_of_body(scene, body, [&](auto, std::size_t i, LaneWorks<One>& works) {
      const Motion of_particle = motion_of_particle(state, i, velocity_in_body(state, body, i, motion), motion);
      add_works_of_half_step<Kinds>(arrays, step, i, forces_on<true, Kinds, One>(arrays, i), of_particle, works);
    }));
    twice_kinetic += scene.rigid.mass[body] * to_number(dot(motion.velocity, motion.next)) +
                     scene.rigid.inertia[body] * to_number(motion.spin * motion.next_spin);
  });
  sum.twice_kinetic = twice_kinetic;  // not that of the particles, whose masses matter for contacts only
  return sum;
}

}  // namespace cellcrush
HWY_AFTER_NAMESPACE();
