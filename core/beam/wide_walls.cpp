#include "beam/wide_walls.h"

#include <algorithm>
#include <span>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beam/wide_walls.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/joint_forces.h"
#include "beam/wall_chunk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::size_t element_count(std::span<const WallBlock> chunk) {
  return chunk.back().first_element + chunk.back().walls * chunk.back().elements - chunk.front().first_element;
}

/// Plastic work of a chunk's step. Full blocks go through the target's vectors, others wall by wall.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class T>
double advance_chunk(const Scene& scene, State& state, FibreMemory<T>& memory,
                     const RuleFactors<kSections, kDepthPoints, T>& rule, std::span<const WallBlock> chunk,
                     ChunkValues<T>& values) {
  using Wide = hn::CappedTag<double, kMostWallsInBlock>;
  using WideFibres = hn::CappedTag<T, kMostWallsInBlock>;
  using One = hn::CappedTag<double, 1>;
  using OneFibre = hn::CappedTag<T, 1>;
  const double step = state.step == 0 ? 0.0 : scene.schedule.time_step;
  values.hold(element_count(chunk));
  double plastic_work[kMostWallsInBlock] = {};
  if (chunk.front().walls == kMostWallsInBlock) {
    WallChunk<kSections, kDepthPoints, kForceBased, kHardening, Wide, WideFibres>(scene, state, memory, step, rule,
                                                                                  chunk, values)
        .advance(plastic_work);
  } else {
    WallChunk<kSections, kDepthPoints, kForceBased, kHardening, One, OneFibre>(scene, state, memory, step, rule, chunk,
                                                                               values)
        .advance(plastic_work);
  }
  double sum = 0.0;
  for (const double work : plastic_work) {
    sum += work;
  }
  return sum;
}

/// Sums the forces on the joints at which two threads' chunks meet.
void sum_between_parts(const Scene& scene, State& state, const Workers& workers, std::size_t chunks) {
  for (int part = 1; part < workers.count(); ++part) {
    const std::size_t chunk = workers.start_of_part(chunks, part);
    if (chunk > 0 && chunk < chunks) {
      sum_joint_forces(scene, state, scene.walls.end_joint[chunk - 1], scene.walls.first_joint[chunk]);
    }
  }
}

/// Every chunk's work is a number of its own, so that the sum does not depend on who computes them. The forces on joints are
/// summed as soon as all their walls have been taken, while they are near.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class T>
void evaluate_blocks(const Scene& scene, State& state, FibreMemory<T>& memory, Workers& workers) {
  const RuleFactors<kSections, kDepthPoints, T> rule(scene.section);
  const std::span<const WallBlock> blocks = scene.walls.blocks;
  const std::vector<int>& offset = scene.walls.chunk_offset;
  std::vector<double> plastic_work(scene.walls.chunk_count());
  workers.share(plastic_work.size(), [&](std::size_t first, std::size_t end) HWY_ATTR {
    ChunkValues<T> values;
    int joint = first < end ? scene.walls.first_joint[first] : 0;
    for (std::size_t c = first; c < end; ++c) {
      plastic_work[c] = advance_chunk<kSections, kDepthPoints, kForceBased, kHardening>(
          scene, state, memory, rule, blocks.subspan(offset[c], offset[c + 1] - offset[c]), values);
      sum_joint_forces(scene, state, joint, scene.walls.end_joint[c]);
      joint = std::max(joint, scene.walls.end_joint[c]);
    }
  });
  sum_between_parts(scene, state, workers, plastic_work.size());
  for (const double work : plastic_work) {
    state.ledger.plastic += work;
  }
}

template <int kSections, int kDepthPoints, bool kForceBased, class T>
void evaluate_rule(const Scene& scene, State& state, FibreMemory<T>& memory, Workers& workers) {
  if (scene.has_hardening()) {
    evaluate_blocks<kSections, kDepthPoints, kForceBased, true>(scene, state, memory, workers);
  } else {
    evaluate_blocks<kSections, kDepthPoints, kForceBased, false>(scene, state, memory, workers);
  }
}

template <class T>
bool evaluate_memory(const Scene& scene, State& state, FibreMemory<T>& memory, Workers& workers) {
  if (!has_vector_kernel(scene.section)) {
    return false;
  }
  if (scene.section.force_based) {
    evaluate_rule<4, 6, true>(scene, state, memory, workers);
  } else {
    evaluate_rule<2, 6, false>(scene, state, memory, workers);
  }
  return true;
}

bool evaluate_wide(const Scene& scene, State& state, Workers& workers) {
  return scene.single_fibres ? evaluate_memory(scene, state, state.single_fibres, workers)
                             : evaluate_memory(scene, state, state.fibres, workers);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_wide);

bool evaluate_walls_wide(const Scene& scene, State& state, Workers& workers) {
  return HWY_DYNAMIC_DISPATCH(evaluate_wide)(scene, state, workers);
}

}  // namespace cellcrush
#endif
