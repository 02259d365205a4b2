#include "step/wide_motion.h"

#include <algorithm>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "step/wide_motion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

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
};

double sum_of(const double* lanes) {
  double sum = 0.0;
  for (int lane = 0; lane < kSumLanes; ++lane) {
    sum += lanes[lane];
  }
  return sum;
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

/// Those of consecutive particles, cleared in the array. Most are 0, and are then neither parted nor written.
template <class D>
HWY_INLINE LaneContactForces<D> take_contact_forces(D d, ContactForce* HWY_RESTRICT from) {
  double* values = from->elastic.data();
  const auto zero = hn::Zero(d);
  const auto part = [&](std::size_t k) HWY_ATTR { return hn::LoadU(d, values + k * hn::Lanes(d)); };
  const auto all = hn::Or(hn::Or(part(0), part(1)), hn::Or(part(2), part(3)));
  LaneContactForces<D> forces = {{zero, zero}, {zero, zero}};
  if (hn::AllTrue(d, hn::Eq(all, zero))) {
    return forces;
  }
  if constexpr (hn::MaxLanes(D()) == 1) {
    forces = {load_points(d, &from->elastic), load_points(d, &from->viscous)};
  } else {
    hn::LoadInterleaved4(d, values, forces.elastic.x, forces.elastic.y, forces.viscous.x, forces.viscous.y);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    hn::StoreU(zero, d, values + k * hn::Lanes(d));
  }
  return forces;
}

template <bool kFriction, bool kMassDamping, class D>
HWY_INLINE void move(D d, const Scene& scene, State& state, const Motion& motion, std::size_t i, int lane,
                     LaneWorks& works) {
  const auto [contact, viscous] = take_contact_forces(d, &state.contact_force[i]);
  Points<D> force = load_points(d, &state.internal_force[i]);
  force = {hn::Add(force.x, hn::Add(contact.x, viscous.x)), hn::Add(force.y, hn::Add(contact.y, viscous.y))};
  Points<D> friction;
  if constexpr (kFriction) {
    friction = load_points(d, &state.friction_force[i]);
    store_points(d, Points<D>{hn::Zero(d), hn::Zero(d)}, &state.friction_force[i]);
    force = {hn::Add(force.x, friction.x), hn::Add(force.y, friction.y)};
  }
  const auto keep = hn::Set(d, motion.keep);
  const auto gain = hn::Set(d, motion.gain);
  const auto per_force = hn::Mul(gain, hn::LoadU(d, &scene.inverse_mass[i]));
  const auto per_moment = hn::Mul(gain, hn::LoadU(d, &scene.inverse_inertia[i]));
  const Points<D> velocity = load_points(d, &state.velocity[i]);
  const Points<D> next = {hn::MulAdd(per_force, force.x, hn::Mul(keep, velocity.x)),
                          hn::MulAdd(per_force, force.y, hn::Mul(keep, velocity.y))};
  const auto spin = hn::LoadU(d, &state.spin[i]);
  const auto next_spin = hn::MulAdd(per_moment, hn::LoadU(d, &state.internal_moment[i]), hn::Mul(keep, spin));
  const auto half = hn::Set(d, 0.5 * motion.step);
  const Points<D> sum = {hn::Add(velocity.x, next.x), hn::Add(velocity.y, next.y)};
  const Points<D> mean = {hn::Mul(half, sum.x), hn::Mul(half, sum.y)};
  spend(d, contact, mean, works.contact + lane);
  spend(d, viscous, mean, works.contact_damping + lane);
  if constexpr (kFriction) {
    spend(d, friction, mean, works.friction + lane);
  }
  if constexpr (kMassDamping) {
    const auto of_mass = hn::Set(d, -motion.half_damping);
    const auto momentum = hn::Mul(of_mass, hn::LoadU(d, &scene.mass[i]));
    const auto spin_sum = hn::Add(spin, next_spin);
    const auto turning = hn::Mul(hn::Mul(hn::Mul(of_mass, hn::LoadU(d, &scene.inertia[i])), spin_sum), half);
    double* work = works.mass_damping + lane;
    spend(d, Points<D>{hn::Mul(momentum, sum.x), hn::Mul(momentum, sum.y)}, mean, work);
    hn::StoreU(hn::NegMulAdd(turning, spin_sum, hn::LoadU(d, work)), d, work);
  }
  const auto step = hn::Set(d, motion.step);
  const Points<D> position = load_points(d, &state.position[i]);
  store_points(d, next, &state.velocity[i]);
  hn::StoreU(next_spin, d, &state.spin[i]);
  store_points(d, Points<D>{hn::MulAdd(step, next.x, position.x), hn::MulAdd(step, next.y, position.y)},
               &state.position[i]);
  hn::StoreU(hn::MulAdd(step, next_spin, hn::LoadU(d, &state.rotation[i])), d, &state.rotation[i]);
}

/// Works of a chunk's particles.
struct ChunkWorks {
  double contact = 0.0;
  double contact_damping = 0.0;
  double friction = 0.0;
  double mass_damping = 0.0;
};

template <bool kFriction, bool kMassDamping>
ChunkWorks move_chunk(const Scene& scene, State& state, const Motion& motion, std::size_t first, std::size_t end) {
  const hn::CappedTag<double, kSumLanes> wide;
  const hn::CappedTag<double, 1> one;
  const auto lanes = hn::Lanes(wide);
  LaneWorks works;
  std::size_t i = first;
  for (; i + lanes <= end; i += lanes) {
    move<kFriction, kMassDamping>(wide, scene, state, motion, i, static_cast<int>((i - first) % kSumLanes), works);
  }
  for (; i < end; ++i) {
    move<kFriction, kMassDamping>(one, scene, state, motion, i, static_cast<int>((i - first) % kSumLanes), works);
  }
  return {sum_of(works.contact), sum_of(works.contact_damping), sum_of(works.friction), sum_of(works.mass_damping)};
}

/// Particles that are dealt out together: their chunks begin at the first.
struct Group {
  std::size_t first;
  std::size_t end;

  static constexpr std::size_t kChunk = 256;

  [[nodiscard]] std::size_t chunk_count() const { return (end - first + kChunk - 1) / kChunk; }
};

/// Every chunk's works are numbers of their own, so that the sums do not depend on who computes them. Joints and particles
/// inside walls are dealt out each by themselves, as the joints' sums and the walls are, so that a thread finds in its cache
/// what it has written.
template <bool kFriction, bool kMassDamping>
void move_all(const Scene& scene, State& state, Workers& workers) {
  const double step = scene.schedule.time_step;
  const double damping = 0.5 * scene.mass_damping * step;
  const Motion motion = {step, (1.0 - damping) / (1.0 + damping), step / (1.0 + damping), 0.5 * scene.mass_damping};
  const auto joints = static_cast<std::size_t>(scene.joint_count);
  const Group groups[] = {{static_cast<std::size_t>(scene.rigid.particle_count()), joints},
                          {joints, scene.particle_count()}};
  std::vector<ChunkWorks> works(groups[0].chunk_count() + groups[1].chunk_count());
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
  for (const ChunkWorks& work : works) {
    state.ledger.contact += work.contact;
    state.ledger.contact_damping += work.contact_damping;
    state.ledger.friction += work.friction;
    state.ledger.mass_damping += work.mass_damping;
  }
}

void move_wide(const Scene& scene, State& state, Workers& workers) {
  const bool damped = scene.mass_damping > 0.0;
  if (state.friction_force.empty()) {
    damped ? move_all<false, true>(scene, state, workers) : move_all<false, false>(scene, state, workers);
  } else {
    damped ? move_all<true, true>(scene, state, workers) : move_all<true, false>(scene, state, workers);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(move_wide);

bool move_particles_wide(const Scene& scene, State& state, Workers& workers) {
  if (!scene.supports.empty() || !scene.motions.empty() || scene.is_loaded()) {
    return false;
  }
  HWY_DYNAMIC_DISPATCH(move_wide)(scene, state, workers);
  return true;
}

}  // namespace cellcrush
#endif
