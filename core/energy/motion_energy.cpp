#include "energy/motion_energy.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "energy/motion_energy.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "motion/motion_works-inl.h"
#include "motion/particle_motion-inl.h"
#include "motion/rigid_motion.h"
#include "scene/bands.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Works on the free particles, in the chunks in which they are moved.
MotionWorks works_of_particles(const Scene& scene, const State& state) {
  const StepFactors step = step_factors_of(scene);
  const ParticleArrays<const State> arrays(scene, state);
  MotionWorks sum;
  with_force_kinds(scene, state, [&](auto kinds) HWY_ATTR {
    using Kinds = decltype(kinds);
    constexpr std::size_t kWidth = Kinds::kFrame ? 1 : kSumLanes;
    const auto add_range = [&](std::size_t first, std::size_t end) HWY_ATTR {
      for (std::size_t begin = first; begin < end; begin += kParticlesMovedTogether) {
        const std::size_t chunk_end = std::min(begin + kParticlesMovedTogether, end);
        sum.add(sum_works<kWidth>(begin, chunk_end, [&](auto d, std::size_t i, auto& works) HWY_ATTR {
          const auto forces = forces_on<true, Kinds, decltype(d)>(arrays, i);
          add_works_of_half_step<Kinds>(arrays, step, i, forces, motion_of<Kinds>(arrays, step, forces, i), works);
        }));
      }
    };
    add_range(first_free_particle(scene), static_cast<std::size_t>(scene.joint_count));
    add_range(static_cast<std::size_t>(scene.joint_count), scene.particle_count());
  });
  return sum;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(works_of_particles);

MotionWorks half_step_works(const Scene& scene, const State& state) {
  MotionWorks sum = half_step_works_of_rigid_bodies(scene, state);
  sum.add(HWY_DYNAMIC_DISPATCH(works_of_particles)(scene, state));
  return sum;
}

}  // namespace cellcrush
#endif
