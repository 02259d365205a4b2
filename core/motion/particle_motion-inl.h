// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_MOTION_PARTICLE_MOTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_MOTION_PARTICLE_MOTION_INL_H_
#undef CELLCRUSH_MOTION_PARTICLE_MOTION_INL_H_
#else
#define CELLCRUSH_MOTION_PARTICLE_MOTION_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "simd/lane-inl.h"
#include "simd/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Factors of the central differences, from the step and the mass damping alpha (E2).
struct StepFactors {
  double step;          ///< dt, s
  double keep;          ///< (1 - a) / (1 + a), the fraction of a velocity that remains
  double gain;          ///< dt / (1 + a), s, the time during which a force accelerates
  double half_damping;  ///< alpha / 2, 1/s
};

/// Mass damping -alpha m v acts on the mean of the velocities half a step before and half a step after. It is then
/// second-order accurate, and stable for any alpha.
inline StepFactors step_factors_of(const Scene& scene) {
  const double step = scene.schedule.time_step;
  const double damping = 0.5 * scene.mass_damping * step;
  return {step, (1.0 - damping) / (1.0 + damping), step / (1.0 + damping), 0.5 * scene.mass_damping};
}

/// Kinds of forces on the particles of a scene besides those of walls, plates and contacts. A kind that is absent costs
/// nothing.
template <bool friction, bool mass_damping, bool frame>
struct ForceKinds {
  static constexpr bool kFriction = friction;
  static constexpr bool kMassDamping = mass_damping;
  static constexpr bool kFrame = frame;  ///< loads, supports or bending segments; one particle at a time
};

/// Calls use(kinds) with the ForceKinds of a scene.
template <class Use>
HWY_INLINE auto with_force_kinds(const Scene& scene, const State& state, const Use& use) {
  const bool rubs = !state.friction_force.empty();
  if (scene.is_loaded() || !scene.supports.empty() || scene.contact.bends) {
    return rubs ? use(ForceKinds<true, true, true>()) : use(ForceKinds<false, true, true>());
  }
  if (scene.mass_damping > 0.0) {
    return rubs ? use(ForceKinds<true, true, false>()) : use(ForceKinds<false, true, false>());
  }
  return rubs ? use(ForceKinds<true, false, false>()) : use(ForceKinds<false, false, false>());
}

/// The arrays of particles. S is State, or const State where nothing moves. Raw pointers: a store may alias the pointer
/// of a vector itself.
template <class S>
struct ParticleArrays {
  template <class T>
  using Pointer = std::conditional_t<std::is_const_v<S>, const T*, T*>;

  const Scene& scene;
  S& state;
  const double* mass = scene.mass.data();
  const double* inertia = scene.inertia.data();
  const double* inverse_mass = scene.inverse_mass.data();
  const double* inverse_inertia = scene.inverse_inertia.data();
  const Vector2* internal_force = state.internal_force.data();
  const double* internal_moment = state.internal_moment.data();
  const Vector2* load_force = scene.is_loaded() ? state.load_force.data() : nullptr;
  const double* load_moment = state.load_moment.data();
  const ContactForce* contact_force = state.contact_force.data();
  const double* contact_moment = state.contact_moment.empty() ? nullptr : state.contact_moment.data();
  const Vector2* friction_force = state.friction_force.data();
  const std::uint64_t* contact_tiles = state.contact_tiles.empty() ? nullptr : state.contact_tiles.data();
  Pointer<ReactionImpulse> reaction_impulse = state.reaction_impulse.data();  ///< one for each of Scene::supports
  Pointer<Vector2> position = state.position.data();
  Pointer<Vector2> velocity = state.velocity.data();
  Pointer<double> rotation = state.rotation.data();
  Pointer<double> spin = state.spin.data();

  HWY_INLINE ParticleArrays(const Scene& of_scene, S& of_state) : scene(of_scene), state(of_state) {}
};

/// Forces on the particles of the lanes, N and N mm, without mass damping. Kinds that are absent are left out.
template <class D>
struct ParticleForces {
  Points<D> total;
  Lane<D> moment;
  Points<D> elastic;  ///< of contacts
  Points<D> viscous;  ///< of contacts
  Points<D> friction;
  Points<D> load;
  Lane<D> load_moment;
  Lane<D> contact_moment;

  HWY_INLINE ParticleForces() : load{0, 0}, load_moment(0), contact_moment(0) {}
};

template <class D>
HWY_INLINE void load_contact_forces(const ContactForce* from, ParticleForces<D>& forces) {
  if constexpr (Lane<D>::kWidth == 1) {
    forces.elastic = Points<D>::load(&from->elastic);
    forces.viscous = Points<D>::load(&from->viscous);
  } else {
    hn::LoadInterleaved4(D(), from->elastic.data(), forces.elastic.x.raw, forces.elastic.y.raw, forces.viscous.x.raw,
                         forces.viscous.y.raw);
  }
}

/// Sum of the forces on particles from `i` on (Eq. 4; F of E2). kContact: some of them may have contact forces.
template <bool kContact, class Kinds, class D, class S>
HWY_INLINE ParticleForces<D> forces_on(const ParticleArrays<S>& arrays, std::size_t i) {
  ParticleForces<D> forces;
  forces.total = Points<D>::load(arrays.internal_force + i);
  forces.moment = Lane<D>::load(arrays.internal_moment + i);
  if constexpr (kContact) {
    load_contact_forces(arrays.contact_force + i, forces);
    forces.total = forces.total + (forces.elastic + forces.viscous);
  }
  if constexpr (kContact && Kinds::kFrame) {
    if (arrays.contact_moment != nullptr) {
      forces.contact_moment = Lane<D>::load(arrays.contact_moment + i);
      forces.moment += forces.contact_moment;
    }
  }
  if constexpr (Kinds::kFriction) {
    forces.friction = Points<D>::load(arrays.friction_force + i);
    forces.total = forces.total + forces.friction;
  }
  if constexpr (Kinds::kFrame) {
    if (arrays.load_force != nullptr) {
      forces.load = Points<D>::load(arrays.load_force + i);
      forces.load_moment = Lane<D>::load(arrays.load_moment + i);
      forces.total = forces.total + forces.load;
      forces.moment += forces.load_moment;
    }
  }
  return forces;
}

/// Velocities half a step before and half a step after the forces (Eq. 4, central differences, E2).
template <class D>
struct ParticleMotion {
  Points<D> velocity;  ///< mm/s
  Points<D> next;
  Lane<D> spin;  ///< rad/s
  Lane<D> next_spin;
  Points<D> reaction;       ///< N, of supports
  Lane<D> reaction_moment;  ///< N mm

  HWY_INLINE ParticleMotion() : reaction{0, 0}, reaction_moment(0) {}
};

/// v(n+1/2) from v(n-1/2) under forces F(n) (E2), and the same of spins under moments. `gain_per_mass`: the gain of the
/// step over mass or inertia.
template <class D, class V>
HWY_INLINE V next_velocity(const StepFactors& step, const V& velocity, Lane<D> gain_per_mass, const V& force) {
  return fma(gain_per_mass, force, Lane<D>(step.keep) * velocity);
}

/// Motion of the particles from `i` on, which belong to no rigid body.
template <class Kinds, class D, class S>
HWY_INLINE ParticleMotion<D> motion_of(const ParticleArrays<S>& arrays, const StepFactors& step,
                                       const ParticleForces<D>& forces, std::size_t i) {
  const Lane<D> gain = step.gain;
  ParticleMotion<D> motion;
  motion.velocity = Points<D>::load(arrays.velocity + i);
  motion.spin = Lane<D>::load(arrays.spin + i);
  motion.next = next_velocity(step, motion.velocity, gain * Lane<D>::load(arrays.inverse_mass + i), forces.total);
  motion.next_spin = next_velocity(step, motion.spin, gain * Lane<D>::load(arrays.inverse_inertia + i), forces.moment);
  if constexpr (Kinds::kFrame) {
    if (!arrays.scene.supports.empty()) {
      apply_supports(arrays, step, i, motion);
    }
  }
  return motion;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#ifndef CELLCRUSH_ON_DEVICE  // where nothing is held
#include "motion/supports-inl.h"
#endif

#endif  // CELLCRUSH_MOTION_PARTICLE_MOTION_INL_H_
