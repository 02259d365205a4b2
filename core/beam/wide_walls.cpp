#include "beam/wide_walls.h"

#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beam/wide_walls.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/wall_chunk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Elements of a chunk: few enough that what passes between its loops stays in the nearest cache.
constexpr int kElementsPerChunk = 128;

/// Blocks from `first` on that make a chunk: all full or none.
std::span<const WallBlock> chunk_from(std::span<const WallBlock> blocks) {
  const bool is_full = blocks.front().walls == kMostWallsInBlock;
  std::size_t count = 0;
  for (int elements = 0; count < blocks.size() && (blocks[count].walls == kMostWallsInBlock) == is_full; ++count) {
    elements += blocks[count].walls * blocks[count].elements;
    if (count > 0 && elements > kElementsPerChunk) {
      break;
    }
  }
  return blocks.first(count);
}

std::size_t element_count(std::span<const WallBlock> chunk) {
  return chunk.back().first_element + chunk.back().walls * chunk.back().elements - chunk.front().first_element;
}

/// Full blocks go through the target's vectors, others wall by wall.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class T>
void evaluate_blocks(const Scene& scene, State& state, FibreMemory<T>& memory) {
  using Wide = hn::CappedTag<double, kMostWallsInBlock>;
  using WideFibres = hn::CappedTag<T, kMostWallsInBlock>;
  using One = hn::CappedTag<double, 1>;
  using OneFibre = hn::CappedTag<T, 1>;
  const double step = state.step == 0 ? 0.0 : scene.schedule.time_step;
  const RuleFactors<kSections, kDepthPoints, T> rule(scene.section);
  double plastic_work[kMostWallsInBlock] = {};
  for (std::span<const WallBlock> left = scene.walls.blocks; !left.empty();) {
    const std::span<const WallBlock> chunk = chunk_from(left);
    ChunkValues<T> values(element_count(chunk));
    if (chunk.front().walls == kMostWallsInBlock) {
      WallChunk<kSections, kDepthPoints, kForceBased, kHardening, Wide, WideFibres>(scene, state, memory, step, rule,
                                                                                    chunk, values)
          .advance(plastic_work);
    } else {
      WallChunk<kSections, kDepthPoints, kForceBased, kHardening, One, OneFibre>(scene, state, memory, step, rule,
                                                                                 chunk, values)
          .advance(plastic_work);
    }
    left = left.subspan(chunk.size());
  }
  for (const double work : plastic_work) {
    state.ledger.plastic += work;
  }
}

template <int kSections, int kDepthPoints, bool kForceBased, class T>
void evaluate_rule(const Scene& scene, State& state, FibreMemory<T>& memory) {
  if (scene.has_hardening()) {
    evaluate_blocks<kSections, kDepthPoints, kForceBased, true>(scene, state, memory);
  } else {
    evaluate_blocks<kSections, kDepthPoints, kForceBased, false>(scene, state, memory);
  }
}

template <class T>
bool evaluate_memory(const Scene& scene, State& state, FibreMemory<T>& memory) {
  const SectionRule& rule = scene.section;
  const auto is = [&](bool force_based, std::size_t sections, std::size_t depth) HWY_ATTR {
    return rule.force_based == force_based && rule.section_count() == sections && rule.depth_count() == depth;
  };
  if (is(true, 4, 6)) {
    evaluate_rule<4, 6, true>(scene, state, memory);
  } else if (is(false, 2, 6)) {
    evaluate_rule<2, 6, false>(scene, state, memory);
  } else {
    return false;
  }
  return true;
}

bool evaluate_wide(const Scene& scene, State& state) {
  return scene.single_fibres ? evaluate_memory(scene, state, state.single_fibres)
                             : evaluate_memory(scene, state, state.fibres);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_wide);

bool evaluate_walls_wide(const Scene& scene, State& state) { return HWY_DYNAMIC_DISPATCH(evaluate_wide)(scene, state); }

}  // namespace cellcrush
#endif
