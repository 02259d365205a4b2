#include "motion/integrate_motion.h"

#include <algorithm>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "motion/integrate_motion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/contact_tiles.h"
#include "contact/topology/bands.h"
#include "motion/move_particles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Records the particles that may touch a plate at their new positions, and those with friction at a plate.
struct NearPlatesNotes {
  const NearRange reach;
  const bool along_x;
  const double* const impact_friction;  ///< null without friction
  const double* const support_friction;
  int* const near;  ///< room for all recorded particles
  std::size_t count = 0;

  template <class D>
  HWY_INLINE void note(const Points<D>& position, std::size_t i) {
    const Lane<D> along = along_x ? position.x : position.y;
    LaneMask<D> is_near = (along < reach.below) | (along > reach.above);
    if (impact_friction != nullptr) {
      is_near = is_near | (Lane<D>::load(impact_friction + i) != 0) | (Lane<D>::load(support_friction + i) != 0);
    }
    if (HWY_UNLIKELY(any(is_near))) {
      count += write_set_lanes(is_near, i, near + count);
    }
  }
};

/// Whether any lane's particle bears contact forces. Most have none.
template <class D>
HWY_INLINE bool bear_contact(const ParticleArrays<State>& arrays, std::size_t i) {
  if (!may_bear_contact(arrays.contact_tiles, i, Lane<D>::kWidth)) {
    return false;
  }
  const double* const forces = arrays.contact_force[i].elastic.data();
  const auto part = [&](std::size_t k) HWY_ATTR { return hn::LoadU(D(), forces + k * Lane<D>::kWidth); };
  const Lane<D> bits = hn::Or(hn::Or(part(0), part(1)), hn::Or(part(2), part(3)));
  return !all(bits == 0);  // not any(bits != 0): the bits of several numbers may be those of a NaN
}

template <class Kinds>
MotionWorks move_chunk(const ParticleArrays<State>& arrays, const StepFactors& step, std::size_t first, std::size_t end,
                       NearPlatesNotes& near_plates) {
  constexpr std::size_t kWidth = Kinds::kFrame ? 1 : kSumLanes;
  return sum_works<kWidth>(first, end, [&](auto d, std::size_t i, auto& works) HWY_ATTR {
    using D = decltype(d);
    if (bear_contact<D>(arrays, i)) {
      move<true, Kinds>(arrays, step, i, works, near_plates);
    } else {
      move<false, Kinds>(arrays, step, i, works, near_plates);
    }
  });
}

/// Moves the chunks first_chunk ... end_chunk of particles from `first` to `end`, and clears the contact forces that
/// moved them while these are in the cache.
void move_chunks(const Scene& scene, State& state, const NearRange& reach, std::size_t first, std::size_t end,
                 std::size_t first_chunk, std::size_t end_chunk, MovedChunk* moved, int* near_plates) {
  const StepFactors step = step_factors_of(scene);
  const ParticleArrays<State> arrays(scene, state);
  const bool along_x = scene.plates.axis == 0;
  const double* const impact_friction = state.impact_friction.empty() ? nullptr : state.impact_friction.data();
  const double* const support_friction = state.support_friction.data();
  with_force_kinds(scene, state, [&](auto kinds) HWY_ATTR {
    for (std::size_t c = first_chunk; c < end_chunk; ++c) {
      const std::size_t begin = first + c * kParticlesMovedTogether;
      NearPlatesNotes near{reach, along_x, impact_friction, support_friction, near_plates + begin};
      const std::size_t chunk_end = std::min(begin + kParticlesMovedTogether, end);
      const MotionWorks works = move_chunk<decltype(kinds)>(arrays, step, begin, chunk_end, near);
      clear_contact_forces(state, static_cast<int>(begin), static_cast<int>(chunk_end));
      moved[c] = {works, begin, near.count};
    }
  });
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(move_chunks);

namespace {

int chunks_of(int particles) { return (particles + kParticlesMovedTogether - 1) / kParticlesMovedTogether; }

/// Particles that are dealt out together, a band's joints or its particles inside walls, and the first of their chunks.
struct Group {
  int first;
  int end;
  int first_chunk;

  [[nodiscard]] int chunk_count() const { return chunks_of(end - first); }
};

Group joints_of(const Scene& scene, const LatticeBand& band) {
  const int rigid = scene.rigid.particle_count();
  const int first = std::max(band.first_joint, rigid);
  return {first, band.end_joint, chunks_of(first - rigid)};
}

Group inner_of(const Scene& scene, const LatticeBand& band) {
  const int joint_chunks = chunks_of(scene.joint_count - scene.rigid.particle_count());
  return {band.first_inner, band.end_inner, joint_chunks + chunks_of(band.first_inner - scene.joint_count)};
}

/// What a group's chunks have noted, moved together from index `to` on; returns its end.
std::size_t close_up(const Group& group, const std::vector<MovedChunk>& moved, std::size_t to,
                     std::vector<int>& near_plates) {
  for (int c = group.first_chunk; c < group.first_chunk + group.chunk_count(); ++c) {
    std::copy_n(&near_plates[moved[c].first], moved[c].near_count, &near_plates[to]);
    to += moved[c].near_count;
  }
  return to;
}

}  // namespace

ParticleRange moved_chunk(const Scene& scene, std::size_t chunk) {
  const auto rigid = static_cast<std::size_t>(scene.rigid.particle_count());
  const auto joints = static_cast<std::size_t>(scene.joint_count);
  const auto of_joints = static_cast<std::size_t>(chunks_of(scene.joint_count - scene.rigid.particle_count()));
  const bool is_inner = chunk >= of_joints;
  const std::size_t first =
      is_inner ? joints + (chunk - of_joints) * kParticlesMovedTogether : rigid + chunk * kParticlesMovedTogether;
  return {first, std::min(first + kParticlesMovedTogether, is_inner ? scene.particle_count() : joints)};
}

std::size_t moved_chunk_count(const Scene& scene) {
  const Group inner = inner_of(scene, whole_band(scene));
  return inner.first_chunk + inner.chunk_count();
}

/// Every chunk's works are numbers of their own, so that the sums do not depend on who computes them. Joints and
/// particles inside walls are dealt out each by themselves, as the joints' sums and the walls are, so that a thread
/// finds in its cache what it has written.
NearCounts integrate_motion(const Scene& scene, State& state, const LatticeBand& band, const NearRange& reach,
                            Workers& workers, std::vector<MovedChunk>& moved, std::vector<int>& near_plates) {
  const Group joints = joints_of(scene, band);
  const Group inner = inner_of(scene, band);
  const auto move_part = [&](std::size_t part, std::size_t, std::size_t) {
    for (const Group& group : {joints, inner}) {
      HWY_DYNAMIC_DISPATCH(move_chunks)
      (scene, state, reach, group.first, group.end, workers.start_of_part(group.chunk_count(), part),
       workers.start_of_part(group.chunk_count(), part + 1), &moved[group.first_chunk], near_plates.data());
    }
  };
  workers.parallel_ranges(static_cast<std::size_t>(workers.count()), 1, move_part);
  // Particles of rigid bodies have moved with them. They are few: all may be near.
  clear_contact_forces(state, band.first_joint, joints.first);
  std::iota(near_plates.begin() + band.first_joint, near_plates.begin() + joints.first, band.first_joint);
  const std::size_t end_of_joints = close_up(joints, moved, joints.first, near_plates);
  const std::size_t end_of_inner = close_up(inner, moved, inner.first, near_plates);
  return {end_of_joints - band.first_joint, end_of_inner - inner.first};
}

}  // namespace cellcrush
#endif
