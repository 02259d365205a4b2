#include "step/wide_motion.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "step/wide_motion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/contact_lots.h"
#include "simd/lanes-inl.h"
#include "simd/target.h"
#include "step/integrate_motion.h"
#include "step/lane_works-inl.h"
#include "step/near_plates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// See next_velocity.
struct Motion {
  double step;
  double keep;
  double gain;
  double half_damping;
};

/// Where the particles' numbers lie, in one place, so that no store of a number makes the processor look for them again; S is
/// State, or const State where nothing moves.
template <class S>
struct ParticleArrays {
  template <class T>
  using Pointer = std::conditional_t<std::is_const_v<S>, const T*, T*>;

  const double* mass;
  const double* inertia;
  const double* inverse_mass;
  const double* inverse_inertia;
  const Vector2* internal_force;
  const double* internal_moment;
  const std::uint8_t* contact_lots;
  Pointer<Vector2> position;
  Pointer<Vector2> velocity;
  Pointer<double> rotation;
  Pointer<double> spin;
  Pointer<ContactForce> contact_force;
  Pointer<Vector2> friction_force;

  ParticleArrays(const Scene& scene, S& state)
      : mass(scene.mass.data()),
        inertia(scene.inertia.data()),
        inverse_mass(scene.inverse_mass.data()),
        inverse_inertia(scene.inverse_inertia.data()),
        internal_force(state.internal_force.data()),
        internal_moment(state.internal_moment.data()),
        contact_lots(state.contact_lots.empty() ? nullptr : state.contact_lots.data()),
        position(state.position.data()),
        velocity(state.velocity.data()),
        rotation(state.rotation.data()),
        spin(state.spin.data()),
        contact_force(state.contact_force.data()),
        friction_force(state.friction_force.data()) {}
};

/// Forces of contacts.
template <class D>
struct LaneContactForces {
  Points<D> elastic;
  Points<D> viscous;
};

/// Those of consecutive particles.
template <class D>
HWY_INLINE LaneContactForces<D> load_contact_forces(D d, const ContactForce* from) {
  LaneContactForces<D> forces;
  if constexpr (hn::MaxLanes(D()) == 1) {
    forces = {load_points(d, &from->elastic), load_points(d, &from->viscous)};
  } else {
    hn::LoadInterleaved4(d, from->elastic.data(), forces.elastic.x, forces.elastic.y, forces.viscous.x,
                         forces.viscous.y);
  }
  return forces;
}

/// Whether any lane's particle has such a force. Most have none.
template <class D>
HWY_INLINE bool has_contact_forces(D d, const ContactForce* from) {
  const auto part = [&](std::size_t k) HWY_ATTR { return hn::LoadU(d, from->elastic.data() + k * hn::Lanes(d)); };
  const auto all = hn::Or(hn::Or(part(0), part(1)), hn::Or(part(2), part(3)));
  return !hn::AllTrue(d, hn::Eq(all, hn::Zero(d)));
}

template <class D>
HWY_INLINE void clear_contact_forces(D d, ContactForce* at) {
  for (std::size_t k = 0; k < 4; ++k) {
    hn::StoreU(hn::Zero(d), d, at->elastic.data() + k * hn::Lanes(d));
  }
}

/// Motion of the lanes' particles before and after a step, and the forces that change it; see next_velocity.
template <class D>
struct LaneMotion {
  LaneContactForces<D> contact;
  Points<D> friction;
  Points<D> velocity;
  Points<D> next;
  Points<D> sum;  // of both
  hn::Vec<D> spin;
  hn::Vec<D> next_spin;
};

template <bool kContact, bool kFriction, class S, class D>
HWY_INLINE LaneMotion<D> motion_of(D d, const ParticleArrays<S>& arrays, const Motion& motion, std::size_t i) {
  LaneMotion<D> lanes;
  Points<D> force = load_points(d, arrays.internal_force + i);
  if constexpr (kContact) {
    const LaneContactForces<D> contact = lanes.contact = load_contact_forces(d, arrays.contact_force + i);
    force = {hn::Add(force.x, hn::Add(contact.elastic.x, contact.viscous.x)),
             hn::Add(force.y, hn::Add(contact.elastic.y, contact.viscous.y))};
  }
  if constexpr (kFriction) {
    lanes.friction = load_points(d, arrays.friction_force + i);
    force = {hn::Add(force.x, lanes.friction.x), hn::Add(force.y, lanes.friction.y)};
  }
  const auto keep = hn::Set(d, motion.keep);
  const auto gain = hn::Set(d, motion.gain);
  const auto per_force = hn::Mul(gain, hn::LoadU(d, arrays.inverse_mass + i));
  const auto per_moment = hn::Mul(gain, hn::LoadU(d, arrays.inverse_inertia + i));
  lanes.velocity = load_points(d, arrays.velocity + i);
  lanes.next = {hn::MulAdd(per_force, force.x, hn::Mul(keep, lanes.velocity.x)),
                hn::MulAdd(per_force, force.y, hn::Mul(keep, lanes.velocity.y))};
  lanes.sum = {hn::Add(lanes.velocity.x, lanes.next.x), hn::Add(lanes.velocity.y, lanes.next.y)};
  lanes.spin = hn::LoadU(d, arrays.spin + i);
  lanes.next_spin = hn::MulAdd(per_moment, hn::LoadU(d, arrays.internal_moment + i), hn::Mul(keep, lanes.spin));
  return lanes;
}

/// Adds the works of the forces over displacements and turns; see accumulate_work.
template <bool kContact, bool kFriction, bool kMassDamping, class S, class D>
HWY_INLINE void add_works(D d, const ParticleArrays<S>& arrays, const Motion& motion, std::size_t i,
                          const LaneMotion<D>& lanes, const Points<D>& displacement, hn::Vec<D> turn,
                          LaneWorks<D>& works) {
  if constexpr (kContact) {
    spend<D>(lanes.contact.elastic, displacement, works.contact);
    spend<D>(lanes.contact.viscous, displacement, works.contact_damping);
  }
  if constexpr (kFriction) {
    spend<D>(lanes.friction, displacement, works.friction);
  }
  if constexpr (kMassDamping) {
    const auto of_mass = hn::Set(d, -motion.half_damping);
    const auto momentum = hn::Mul(of_mass, hn::LoadU(d, arrays.mass + i));
    const auto moment =
        hn::Mul(hn::Mul(of_mass, hn::LoadU(d, arrays.inertia + i)), hn::Add(lanes.spin, lanes.next_spin));
    spend<D>({hn::Mul(momentum, lanes.sum.x), hn::Mul(momentum, lanes.sum.y)}, displacement, works.mass_damping);
    works.mass_damping = hn::NegMulAdd(moment, turn, works.mass_damping);
  }
}

template <bool kContact, bool kFriction, bool kMassDamping, class D>
HWY_INLINE void move(D d, const ParticleArrays<State>& arrays, const Motion& motion, std::size_t i, LaneWorks<D>& works,
                     NearPlatesNotes& near_plates) {
  const LaneMotion<D> lanes = motion_of<kContact, kFriction>(d, arrays, motion, i);
  if constexpr (kContact) {
    clear_contact_forces(d, arrays.contact_force + i);
  }
  if constexpr (kFriction) {
    store_points(d, Points<D>{hn::Zero(d), hn::Zero(d)}, arrays.friction_force + i);
  }
  const auto half = hn::Set(d, 0.5 * motion.step);
  const Points<D> mean = {hn::Mul(half, lanes.sum.x), hn::Mul(half, lanes.sum.y)};
  const auto mean_turn = hn::Mul(half, hn::Add(lanes.spin, lanes.next_spin));
  add_works<kContact, kFriction, kMassDamping>(d, arrays, motion, i, lanes, mean, mean_turn, works);
  const auto step = hn::Set(d, motion.step);
  const Points<D> before = load_points(d, arrays.position + i);
  const Points<D> position = {hn::MulAdd(step, lanes.next.x, before.x), hn::MulAdd(step, lanes.next.y, before.y)};
  near_plates.note(d, position, i);
  store_points(d, lanes.next, arrays.velocity + i);
  hn::StoreU(lanes.next_spin, d, arrays.spin + i);
  store_points(d, position, arrays.position + i);
  hn::StoreU(hn::MulAdd(step, lanes.next_spin, hn::LoadU(d, arrays.rotation + i)), d, arrays.rotation + i);
}

/// Nothing moves: the works of the half step up to now, and twice the kinetic energy now.
template <bool kFriction, bool kMassDamping, class D>
HWY_INLINE void look(D d, const ParticleArrays<const State>& arrays, const Motion& motion, std::size_t i,
                     LaneWorks<D>& works) {
  const LaneMotion<D> lanes = motion_of<true, kFriction>(d, arrays, motion, i);
  const auto half = hn::Set(d, 0.5 * motion.step);
  const Points<D> displacement = {hn::Mul(half, lanes.velocity.x), hn::Mul(half, lanes.velocity.y)};
  const auto turn = hn::Mul(half, lanes.spin);
  add_works<true, kFriction, kMassDamping>(d, arrays, motion, i, lanes, displacement, turn, works);
  const auto of_spin = hn::Mul(hn::LoadU(d, arrays.inertia + i), hn::Mul(lanes.spin, lanes.next_spin));
  const auto of_both = hn::MulAdd(hn::LoadU(d, arrays.mass + i), dot(lanes.velocity, lanes.next), of_spin);
  works.twice_kinetic = hn::Add(works.twice_kinetic, of_both);
}

template <bool kFriction, bool kMassDamping>
WorksOfMotion move_chunk(const ParticleArrays<State>& arrays, const Motion& motion, std::size_t first, std::size_t end,
                         NearPlatesNotes& near_plates) {
  return sum_over_chunk(first, end, [&](auto d, std::size_t i, auto& works) HWY_ATTR {
    if (may_bear_contact(arrays.contact_lots, i, hn::Lanes(d)) && has_contact_forces(d, arrays.contact_force + i)) {
      move<true, kFriction, kMassDamping>(d, arrays, motion, i, works, near_plates);
    } else {
      move<false, kFriction, kMassDamping>(d, arrays, motion, i, works, near_plates);
    }
  });
}

template <bool kFriction, bool kMassDamping>
WorksOfMotion look_at_chunk(const ParticleArrays<const State>& arrays, const Motion& motion, std::size_t first,
                            std::size_t end) {
  return sum_over_chunk(first, end, [&](auto d, std::size_t i, auto& works) HWY_ATTR {
    look<kFriction, kMassDamping>(d, arrays, motion, i, works);
  });
}

/// Particles that are dealt out together: their chunks begin at the first.
struct Group {
  std::size_t first;
  std::size_t end;

  static constexpr std::size_t kChunk = kParticlesMovedTogether;

  [[nodiscard]] std::size_t chunk_count() const { return moved_chunks(end - first); }
};

std::array<Group, 2> groups_of(const Scene& scene) {
  const auto joints = static_cast<std::size_t>(scene.joint_count);
  return {{{static_cast<std::size_t>(scene.rigid.particle_count()), joints}, {joints, scene.particle_count()}}};
}

Motion motion_over_step(const Scene& scene) {
  const auto [keep, gain] = damped_step_of(scene);
  return {scene.schedule.time_step, keep, gain, 0.5 * scene.mass_damping};
}

/// Moves chunks of a group, of which the first is `before` among all.
template <bool kFriction, bool kMassDamping>
void move_chunks(const Scene& scene, State& state, const PlateReach& reach, const Group& group, std::size_t before,
                 std::size_t first_chunk, std::size_t end_chunk, MovedChunk* moved, int* near_plates) {
  const Motion motion = motion_over_step(scene);
  const ParticleArrays<State> arrays(scene, state);
  for (std::size_t c = first_chunk; c < end_chunk; ++c) {
    const std::size_t first = group.first + c * Group::kChunk;
    const std::size_t end = std::min(first + Group::kChunk, group.end);
    NearPlatesNotes near(scene, state, reach, &near_plates[first]);
    const WorksOfMotion works = move_chunk<kFriction, kMassDamping>(arrays, motion, first, end, near);
    moved[before + c] = {works, first, near.count()};
  }
}

/// Every chunk's works are numbers of their own, so that the sums do not depend on who computes them. Joints and particles
/// inside walls are dealt out each by themselves, as the joints' sums and the walls are, so that a thread finds in its cache
/// what it has written.
template <bool kFriction, bool kMassDamping>
void move_all(const Scene& scene, State& state, const PlateReach& reach, MotionWorkspace& workspace, Workers& workers) {
  const std::array<Group, 2> groups = groups_of(scene);
  workspace.chunks.resize(moved_chunk_count(scene));
  workspace.near_plates.resize(scene.particle_count());
  workers.share_parts(
      static_cast<std::size_t>(workers.count()), 1, [&](std::size_t part, std::size_t, std::size_t) HWY_ATTR {
        std::size_t before = 0;
        for (const Group& group : groups) {
          const std::size_t chunks = group.chunk_count();
          move_chunks<kFriction, kMassDamping>(scene, state, reach, group, before, workers.start_of_part(chunks, part),
                                               workers.start_of_part(chunks, part + 1), workspace.chunks.data(),
                                               workspace.near_plates.data());
          before += chunks;
        }
      });
  for (const MovedChunk& chunk : workspace.chunks) {
    chunk.works.book(state.ledger);
  }
}

template <bool kFriction, bool kMassDamping>
void move_band(const Scene& scene, State& state, const PlateReach& reach, const LatticeBand& band, MovedChunk* moved,
               int* near_plates) {
  const std::array<Group, 2> groups = groups_of(scene);
  const MovedRanges ranges = moved_ranges_of(scene, band);
  const std::size_t joints = groups[0].chunk_count();
  move_chunks<kFriction, kMassDamping>(scene, state, reach, groups[0], 0, ranges.first_of_joints, ranges.end_of_joints,
                                       moved, near_plates);
  move_chunks<kFriction, kMassDamping>(scene, state, reach, groups[1], joints, ranges.first_of_inner - joints,
                                       ranges.end_of_inner - joints, moved, near_plates);
}

template <bool kFriction, bool kMassDamping>
WorksOfMotion look_at_all(const Scene& scene, const State& state) {
  const Motion motion = motion_over_step(scene);
  const ParticleArrays<const State> arrays(scene, state);
  WorksOfMotion sum;
  for (const Group& group : groups_of(scene)) {
    for (std::size_t c = 0; c < group.chunk_count(); ++c) {
      const std::size_t first = group.first + c * Group::kChunk;
      sum.add(
          look_at_chunk<kFriction, kMassDamping>(arrays, motion, first, std::min(first + Group::kChunk, group.end)));
    }
  }
  return sum;
}

void move_wide(const Scene& scene, State& state, const PlateReach& reach, MotionWorkspace& workspace,
               Workers& workers) {
  const bool damped = scene.mass_damping > 0.0;
  const auto move_them = state.friction_force.empty() ? (damped ? move_all<false, true> : move_all<false, false>)
                                                      : (damped ? move_all<true, true> : move_all<true, false>);
  move_them(scene, state, reach, workspace, workers);
}

void move_band_wide(const Scene& scene, State& state, const PlateReach& reach, const LatticeBand& band,
                    MovedChunk* moved, int* near_plates) {
  const bool damped = scene.mass_damping > 0.0;
  const auto move_it = state.friction_force.empty() ? (damped ? move_band<false, true> : move_band<false, false>)
                                                    : (damped ? move_band<true, true> : move_band<true, false>);
  move_it(scene, state, reach, band, moved, near_plates);
}

WorksOfMotion look_wide(const Scene& scene, const State& state) {
  const bool damped = scene.mass_damping > 0.0;
  if (state.friction_force.empty()) {
    return damped ? look_at_all<false, true>(scene, state) : look_at_all<false, false>(scene, state);
  }
  return damped ? look_at_all<true, true>(scene, state) : look_at_all<true, false>(scene, state);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

MovedRanges moved_ranges_of(const Scene& scene, const LatticeBand& band) {
  const auto chunk_of = [](int particles) { return moved_chunks(static_cast<std::size_t>(particles)); };
  const std::size_t joints = chunk_of(scene.joint_count);
  return {chunk_of(band.first_joint), chunk_of(band.end_joint), joints + chunk_of(band.first_inner - scene.joint_count),
          joints + chunk_of(band.end_inner - scene.joint_count)};
}

HWY_EXPORT(move_wide);
HWY_EXPORT(move_band_wide);
HWY_EXPORT(look_wide);

bool have_wide_motion(const Scene& scene) {
  return use_wide_kernels() && scene.supports.empty() && scene.motions.empty() && !scene.is_loaded();
}

void move_particles_wide(const Scene& scene, State& state, const PlateReach& reach, MotionWorkspace& workspace,
                         Workers& workers) {
  HWY_DYNAMIC_DISPATCH(move_wide)(scene, state, reach, workspace, workers);
}

void move_band_of_particles_wide(const Scene& scene, State& state, const PlateReach& reach, const LatticeBand& band,
                                 MovedChunk* moved, int* near_plates) {
  HWY_DYNAMIC_DISPATCH(move_band_wide)(scene, state, reach, band, moved, near_plates);
}

WorksOfMotion look_at_particles_wide(const Scene& scene, const State& state) {
  return HWY_DYNAMIC_DISPATCH(look_wide)(scene, state);
}

}  // namespace cellcrush
#endif
