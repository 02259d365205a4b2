#include "step/wide_motion.h"

#include <algorithm>
#include <array>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "step/wide_motion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "simd/target.h"
#include "step/integrate_motion.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes over which works are summed, whatever the target's are: the sums then have the same bits.
constexpr int kSumLanes = 8;

/// Works of the forces on the particles, each lane's by itself; see Ledger.
struct LaneWorks {
  double contact[kSumLanes] = {};
  double contact_damping[kSumLanes] = {};
  double friction[kSumLanes] = {};
  double mass_damping[kSumLanes] = {};
  double twice_kinetic[kSumLanes] = {};
};

double sum_of(const double* lanes) {
  double sum = 0.0;
  for (int lane = 0; lane < kSumLanes; ++lane) {
    sum += lanes[lane];
  }
  return sum;
}

WorksOfMotion sums_of(const LaneWorks& works) {
  return {sum_of(works.contact), sum_of(works.contact_damping), sum_of(works.friction), sum_of(works.mass_damping),
          sum_of(works.twice_kinetic)};
}

/// Subtracts force . displacement from a work.
template <class D>
HWY_INLINE void spend(D d, const Points<D>& force, const Points<D>& displacement, double* HWY_RESTRICT work) {
  hn::StoreU(hn::Sub(hn::LoadU(d, work), dot(force, displacement)), d, work);
}

/// See next_velocity.
struct Motion {
  double step;
  double keep;
  double gain;
  double half_damping;
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

/// The same, cleared in the array. Most are 0, and are then neither parted nor written.
template <class D>
HWY_INLINE LaneContactForces<D> take_contact_forces(D d, ContactForce* HWY_RESTRICT from) {
  double* values = from->elastic.data();
  const auto zero = hn::Zero(d);
  const auto part = [&](std::size_t k) HWY_ATTR { return hn::LoadU(d, values + k * hn::Lanes(d)); };
  const auto all = hn::Or(hn::Or(part(0), part(1)), hn::Or(part(2), part(3)));
  if (hn::AllTrue(d, hn::Eq(all, zero))) {
    return {{zero, zero}, {zero, zero}};
  }
  const LaneContactForces<D> forces = load_contact_forces(d, from);
  for (std::size_t k = 0; k < 4; ++k) {
    hn::StoreU(zero, d, values + k * hn::Lanes(d));
  }
  return forces;
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

template <bool kFriction, class D>
HWY_INLINE LaneMotion<D> motion_of(D d, const Scene& scene, const State& state, const Motion& motion, std::size_t i,
                                   const LaneContactForces<D>& contact) {
  LaneMotion<D> lanes;
  lanes.contact = contact;
  Points<D> force = load_points(d, &state.internal_force[i]);
  force = {hn::Add(force.x, hn::Add(contact.elastic.x, contact.viscous.x)),
           hn::Add(force.y, hn::Add(contact.elastic.y, contact.viscous.y))};
  if constexpr (kFriction) {
    lanes.friction = load_points(d, &state.friction_force[i]);
    force = {hn::Add(force.x, lanes.friction.x), hn::Add(force.y, lanes.friction.y)};
  }
  const auto keep = hn::Set(d, motion.keep);
  const auto gain = hn::Set(d, motion.gain);
  const auto per_force = hn::Mul(gain, hn::LoadU(d, &scene.inverse_mass[i]));
  const auto per_moment = hn::Mul(gain, hn::LoadU(d, &scene.inverse_inertia[i]));
  lanes.velocity = load_points(d, &state.velocity[i]);
  lanes.next = {hn::MulAdd(per_force, force.x, hn::Mul(keep, lanes.velocity.x)),
                hn::MulAdd(per_force, force.y, hn::Mul(keep, lanes.velocity.y))};
  lanes.sum = {hn::Add(lanes.velocity.x, lanes.next.x), hn::Add(lanes.velocity.y, lanes.next.y)};
  lanes.spin = hn::LoadU(d, &state.spin[i]);
  lanes.next_spin = hn::MulAdd(per_moment, hn::LoadU(d, &state.internal_moment[i]), hn::Mul(keep, lanes.spin));
  return lanes;
}

/// Adds the works of the forces over displacements and turns; see accumulate_work.
template <bool kFriction, bool kMassDamping, class D>
HWY_INLINE void add_works(D d, const Scene& scene, const Motion& motion, std::size_t i, const LaneMotion<D>& lanes,
                          const Points<D>& displacement, hn::Vec<D> turn, int lane, LaneWorks& works) {
  spend(d, lanes.contact.elastic, displacement, works.contact + lane);
  spend(d, lanes.contact.viscous, displacement, works.contact_damping + lane);
  if constexpr (kFriction) {
    spend(d, lanes.friction, displacement, works.friction + lane);
  }
  if constexpr (kMassDamping) {
    const auto of_mass = hn::Set(d, -motion.half_damping);
    const auto momentum = hn::Mul(of_mass, hn::LoadU(d, &scene.mass[i]));
    const auto moment =
        hn::Mul(hn::Mul(of_mass, hn::LoadU(d, &scene.inertia[i])), hn::Add(lanes.spin, lanes.next_spin));
    double* work = works.mass_damping + lane;
    spend(d, Points<D>{hn::Mul(momentum, lanes.sum.x), hn::Mul(momentum, lanes.sum.y)}, displacement, work);
    hn::StoreU(hn::NegMulAdd(moment, turn, hn::LoadU(d, work)), d, work);
  }
}

template <bool kFriction, bool kMassDamping, class D>
HWY_INLINE void move(D d, const Scene& scene, State& state, const Motion& motion, std::size_t i, int lane,
                     LaneWorks& works) {
  const LaneMotion<D> lanes =
      motion_of<kFriction>(d, scene, state, motion, i, take_contact_forces(d, &state.contact_force[i]));
  if constexpr (kFriction) {
    store_points(d, Points<D>{hn::Zero(d), hn::Zero(d)}, &state.friction_force[i]);
  }
  const auto half = hn::Set(d, 0.5 * motion.step);
  const Points<D> mean = {hn::Mul(half, lanes.sum.x), hn::Mul(half, lanes.sum.y)};
  const auto mean_turn = hn::Mul(half, hn::Add(lanes.spin, lanes.next_spin));
  add_works<kFriction, kMassDamping>(d, scene, motion, i, lanes, mean, mean_turn, lane, works);
  const auto step = hn::Set(d, motion.step);
  const Points<D> position = load_points(d, &state.position[i]);
  store_points(d, lanes.next, &state.velocity[i]);
  hn::StoreU(lanes.next_spin, d, &state.spin[i]);
  store_points(d, Points<D>{hn::MulAdd(step, lanes.next.x, position.x), hn::MulAdd(step, lanes.next.y, position.y)},
               &state.position[i]);
  hn::StoreU(hn::MulAdd(step, lanes.next_spin, hn::LoadU(d, &state.rotation[i])), d, &state.rotation[i]);
}

/// Nothing moves: the works of the half step up to now, and twice the kinetic energy now.
template <bool kFriction, bool kMassDamping, class D>
HWY_INLINE void look(D d, const Scene& scene, const State& state, const Motion& motion, std::size_t i, int lane,
                     LaneWorks& works) {
  const LaneMotion<D> lanes =
      motion_of<kFriction>(d, scene, state, motion, i, load_contact_forces(d, &state.contact_force[i]));
  const auto half = hn::Set(d, 0.5 * motion.step);
  const Points<D> displacement = {hn::Mul(half, lanes.velocity.x), hn::Mul(half, lanes.velocity.y)};
  add_works<kFriction, kMassDamping>(d, scene, motion, i, lanes, displacement, hn::Mul(half, lanes.spin), lane, works);
  double* kinetic = works.twice_kinetic + lane;
  const auto of_spin = hn::Mul(hn::LoadU(d, &scene.inertia[i]), hn::Mul(lanes.spin, lanes.next_spin));
  const auto of_both = hn::MulAdd(hn::LoadU(d, &scene.mass[i]), dot(lanes.velocity, lanes.next), of_spin);
  hn::StoreU(hn::Add(hn::LoadU(d, kinetic), of_both), d, kinetic);
}

/// Calls visit(tag of the lanes, first particle, first lane of the sums) for all of a chunk.
template <class Visit>
HWY_INLINE void visit_chunk(std::size_t first, std::size_t end, Visit&& visit) {
  const hn::CappedTag<double, kSumLanes> wide;
  const hn::CappedTag<double, 1> one;
  std::size_t i = first;
  for (; i + hn::Lanes(wide) <= end; i += hn::Lanes(wide)) {
    visit(wide, i, static_cast<int>((i - first) % kSumLanes));
  }
  for (; i < end; ++i) {
    visit(one, i, static_cast<int>((i - first) % kSumLanes));
  }
}

template <bool kFriction, bool kMassDamping>
WorksOfMotion move_chunk(const Scene& scene, State& state, const Motion& motion, std::size_t first, std::size_t end) {
  LaneWorks works;
  visit_chunk(first, end, [&](auto d, std::size_t i, int lane) HWY_ATTR {
    move<kFriction, kMassDamping>(d, scene, state, motion, i, lane, works);
  });
  return sums_of(works);
}

template <bool kFriction, bool kMassDamping>
WorksOfMotion look_at_chunk(const Scene& scene, const State& state, const Motion& motion, std::size_t first,
                            std::size_t end) {
  LaneWorks works;
  visit_chunk(first, end, [&](auto d, std::size_t i, int lane) HWY_ATTR {
    look<kFriction, kMassDamping>(d, scene, state, motion, i, lane, works);
  });
  return sums_of(works);
}

/// Particles that are dealt out together: their chunks begin at the first.
struct Group {
  std::size_t first;
  std::size_t end;

  static constexpr std::size_t kChunk = 256;

  [[nodiscard]] std::size_t chunk_count() const { return (end - first + kChunk - 1) / kChunk; }
};

std::array<Group, 2> groups_of(const Scene& scene) {
  const auto joints = static_cast<std::size_t>(scene.joint_count);
  return {{{static_cast<std::size_t>(scene.rigid.particle_count()), joints}, {joints, scene.particle_count()}}};
}

Motion motion_over_step(const Scene& scene) {
  const auto [keep, gain] = damped_step_of(scene);
  return {scene.schedule.time_step, keep, gain, 0.5 * scene.mass_damping};
}

/// Every chunk's works are numbers of their own, so that the sums do not depend on who computes them. Joints and particles
/// inside walls are dealt out each by themselves, as the joints' sums and the walls are, so that a thread finds in its cache
/// what it has written.
template <bool kFriction, bool kMassDamping>
void move_all(const Scene& scene, State& state, Workers& workers) {
  const Motion motion = motion_over_step(scene);
  const std::array<Group, 2> groups = groups_of(scene);
  std::vector<WorksOfMotion> works(groups[0].chunk_count() + groups[1].chunk_count());
  workers.share_parts(
      static_cast<std::size_t>(workers.count()), 1, [&](std::size_t part, std::size_t, std::size_t) HWY_ATTR {
        std::size_t before = 0;
        for (const Group& group : groups) {
          const std::size_t chunks = group.chunk_count();
          for (std::size_t c = workers.start_of_part(chunks, part); c < workers.start_of_part(chunks, part + 1); ++c) {
            const std::size_t first = group.first + c * Group::kChunk;
            works[before + c] = move_chunk<kFriction, kMassDamping>(scene, state, motion, first,
                                                                    std::min(first + Group::kChunk, group.end));
          }
          before += chunks;
        }
      });
  for (const WorksOfMotion& work : works) {
    work.book(state.ledger);
  }
}

template <bool kFriction, bool kMassDamping>
WorksOfMotion look_at_all(const Scene& scene, const State& state) {
  const Motion motion = motion_over_step(scene);
  WorksOfMotion sum;
  for (const Group& group : groups_of(scene)) {
    for (std::size_t c = 0; c < group.chunk_count(); ++c) {
      const std::size_t first = group.first + c * Group::kChunk;
      sum.add(look_at_chunk<kFriction, kMassDamping>(scene, state, motion, first,
                                                     std::min(first + Group::kChunk, group.end)));
    }
  }
  return sum;
}

void move_wide(const Scene& scene, State& state, Workers& workers) {
  const bool damped = scene.mass_damping > 0.0;
  if (state.friction_force.empty()) {
    damped ? move_all<false, true>(scene, state, workers) : move_all<false, false>(scene, state, workers);
  } else {
    damped ? move_all<true, true>(scene, state, workers) : move_all<true, false>(scene, state, workers);
  }
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

HWY_EXPORT(move_wide);
HWY_EXPORT(look_wide);

bool have_wide_motion(const Scene& scene) {
  return use_wide_kernels() && scene.supports.empty() && scene.motions.empty() && !scene.is_loaded();
}

void move_particles_wide(const Scene& scene, State& state, Workers& workers) {
  HWY_DYNAMIC_DISPATCH(move_wide)(scene, state, workers);
}

WorksOfMotion look_at_particles_wide(const Scene& scene, const State& state) {
  return HWY_DYNAMIC_DISPATCH(look_wide)(scene, state);
}

}  // namespace cellcrush
#endif
