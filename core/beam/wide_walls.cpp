#include "beam/wide_walls.h"

#include <algorithm>
#include <iterator>
#include <numeric>
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

/// The walls' loops chunk by chunk. Full blocks go through the target's vectors, others wall by wall.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class T>
class WallLoops {
 public:
  WallLoops(const Scene& scene, State& state, FibreMemory<T>& memory)
      : scene_(scene),
        state_(state),
        memory_(memory),
        step_(state.step == 0 ? 0.0 : scene.schedule.time_step),
        rule_(scene.section) {}

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(scene_.walls.chunk_count()); }

  [[nodiscard]] std::span<const WallBlock> blocks_of(std::size_t chunk) const {
    const std::vector<int>& offset = scene_.walls.chunk_offset;
    return std::span(scene_.walls.blocks).subspan(offset[chunk], offset[chunk + 1] - offset[chunk]);
  }

  /// Returns whether some elements have a stiffness of their own.
  bool measure(std::size_t chunk, T* passed) const {
    bool is_squashed = false;
    with_chunk(chunk, passed, [&](auto& walls) HWY_ATTR { is_squashed = walls.measure(); });
    return is_squashed;
  }

  /// Returns the plastic work.
  double respond(std::size_t chunk, T* passed, bool is_squashed) const {
    double work[kMostWallsInBlock] = {};
    with_chunk(chunk, passed, [&](auto& walls) HWY_ATTR { walls.respond(is_squashed, work); });
    return sum_of(work);
  }

  /// Both, and returns the plastic work.
  double advance(std::size_t chunk, LaneVector<T>& passed) const {
    const std::size_t room = kPassedKinds * element_count(blocks_of(chunk));
    if (passed.size() < room) {
      passed.resize(room);
    }
    double work[kMostWallsInBlock] = {};
    with_chunk(chunk, passed.data(), [&](auto& walls) HWY_ATTR { walls.respond(walls.measure(), work); });
    return sum_of(work);
  }

 private:
  template <class D, class F>
  using Chunk = WallChunk<kSections, kDepthPoints, kForceBased, kHardening, D, F>;

  template <class Visit>
  HWY_INLINE void with_chunk(std::size_t chunk, T* passed, const Visit& visit) const {
    const std::span<const WallBlock> blocks = blocks_of(chunk);
    if (blocks.front().walls == kMostWallsInBlock) {
      Chunk<hn::CappedTag<double, kMostWallsInBlock>, hn::CappedTag<T, kMostWallsInBlock>> walls(
          scene_, state_, memory_, step_, rule_, blocks, passed);
      visit(walls);
    } else {
      Chunk<hn::CappedTag<double, 1>, hn::CappedTag<T, 1>> walls(scene_, state_, memory_, step_, rule_, blocks, passed);
      visit(walls);
    }
  }

  static double sum_of(const double (&work)[kMostWallsInBlock]) { return std::accumulate(work, std::end(work), 0.0); }

  const Scene& scene_;
  State& state_;
  FibreMemory<T>& memory_;
  const double step_;
  const RuleFactors<kSections, kDepthPoints, T> rule_;
};

/// Sums the forces on the joints at which two threads' chunks meet.
void sum_between_parts(const Scene& scene, State& state, const Workers& workers, std::size_t chunks) {
  for (int part = 1; part < workers.count(); ++part) {
    const std::size_t chunk = workers.start_of_part(chunks, part);
    if (chunk > 0 && chunk < chunks) {
      sum_joint_forces(scene, state, scene.walls.end_joint[chunk - 1], scene.walls.first_joint[chunk]);
    }
  }
}

/// A chunk's loops one after the other. The forces on joints are summed as soon as all their walls have been taken, while they
/// are near.
template <class T, class Loops>
void advance_chunks(const Loops& loops, const Scene& scene, State& state, std::vector<double>& plastic_work,
                    Workers& workers) {
  workers.share(loops.count(), [&](std::size_t first, std::size_t end) HWY_ATTR {
    LaneVector<T> passed;
    int joint = first < end ? scene.walls.first_joint[first] : 0;
    for (std::size_t c = first; c < end; ++c) {
      plastic_work[c] = loops.advance(c, passed);
      sum_joint_forces(scene, state, joint, scene.walls.end_joint[c]);
      joint = std::max(joint, scene.walls.end_joint[c]);
    }
  });
  sum_between_parts(scene, state, workers, loops.count());
}

/// Chunks that a thread takes at once beside something else.
constexpr std::size_t kChunksInPiece = 2;

/// All chunks' first loop, then the others beside `meanwhile`.
template <class T, class Loops>
void advance_beside(const Loops& loops, const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                    const std::function<void()>& meanwhile) {
  LaneVector<T>& passed = workspace.passed_of<T>();
  passed.resize(kPassedKinds * scene.element_count());
  workspace.squashed.resize(loops.count());
  const auto passed_by = [&](std::size_t c) {
    return &passed[kPassedKinds * loops.blocks_of(c).front().first_element];
  };
  workers.share(loops.count(), [&](std::size_t first, std::size_t end) HWY_ATTR {
    for (std::size_t c = first; c < end; ++c) {
      workspace.squashed[c] = loops.measure(c, passed_by(c)) ? 1 : 0;
    }
  });
  const auto respond = [&](std::size_t piece) HWY_ATTR {
    const std::size_t end = std::min(loops.count(), (piece + 1) * kChunksInPiece);
    for (std::size_t c = piece * kChunksInPiece; c < end; ++c) {
      workspace.plastic_work[c] = loops.respond(c, passed_by(c), workspace.squashed[c] != 0);
    }
  };
  workers.share_beside((loops.count() + kChunksInPiece - 1) / kChunksInPiece, respond, meanwhile);
  workers.share(static_cast<std::size_t>(scene.joint_count),
                [&](std::size_t first, std::size_t end) { sum_joint_forces(scene, state, first, end); });
}

/// Every chunk's work is a number of its own, so that the sum does not depend on who computes them.
template <class T, class Loops>
void evaluate_loops(const Loops& loops, const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                    const std::function<void()>& meanwhile) {
  workspace.plastic_work.resize(loops.count());
  if (workers.count() > 1 && scene.element_count() <= kMostElementsBeside) {
    advance_beside<T>(loops, scene, state, workspace, workers, meanwhile);
  } else {
    advance_chunks<T>(loops, scene, state, workspace.plastic_work, workers);
    meanwhile();
  }
  for (const double work : workspace.plastic_work) {
    state.ledger.plastic += work;
  }
}

/// Calls use(a number of the fibres' type, the loops of the scene's rule).
template <class T, class Use>
void with_loops(const Scene& scene, State& state, FibreMemory<T>& memory, const Use& use) {
  if (scene.section.force_based) {
    scene.has_hardening() ? use(T(), WallLoops<4, 6, true, true, T>(scene, state, memory))
                          : use(T(), WallLoops<4, 6, true, false, T>(scene, state, memory));
  } else {
    scene.has_hardening() ? use(T(), WallLoops<2, 6, false, true, T>(scene, state, memory))
                          : use(T(), WallLoops<2, 6, false, false, T>(scene, state, memory));
  }
}

template <class Use>
void with_loops(const Scene& scene, State& state, const Use& use) {
  scene.single_fibres ? with_loops(scene, state, state.single_fibres, use)
                      : with_loops(scene, state, state.fibres, use);
}

void evaluate_wide(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                   const std::function<void()>& meanwhile) {
  with_loops(scene, state, [&](auto number, const auto& loops) HWY_ATTR {
    evaluate_loops<decltype(number)>(loops, scene, state, workspace, workers, meanwhile);
  });
}

void evaluate_band(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                   double* plastic_work) {
  const std::vector<int>& end_joint = scene.walls.end_joint;
  with_loops(scene, state, [&](auto number, const auto& loops) HWY_ATTR {
    int joint = band.first_chunk > 0 ? end_joint[band.first_chunk - 1] : 0;
    for (int c = band.first_chunk; c < band.end_chunk; ++c) {
      plastic_work[c] = loops.advance(static_cast<std::size_t>(c), workspace.passed_of<decltype(number)>());
      sum_joint_forces(scene, state, joint, end_joint[c]);
      joint = std::max(joint, end_joint[c]);
    }
  });
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_wide);
HWY_EXPORT(evaluate_band);

void evaluate_walls_wide(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                         const std::function<void()>& meanwhile) {
  HWY_DYNAMIC_DISPATCH(evaluate_wide)(scene, state, workspace, workers, meanwhile);
}

void evaluate_band_walls_wide(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                              double* plastic_work) {
  HWY_DYNAMIC_DISPATCH(evaluate_band)(scene, state, band, workspace, plastic_work);
}

}  // namespace cellcrush
#endif
