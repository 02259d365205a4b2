#include "beam/internal_forces.h"

#include <algorithm>
#include <numeric>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beam/internal_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/wall_chunk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// The loops over the walls of a chunk, for one section rule. Full blocks fill vectors. Other blocks, and rules whose
/// numbers of points are not known at compile time, are computed wall by wall.
template <bool kForceBased, class Law, class Rule>
class WallLoops {
 public:
  using T = typename Rule::Number;

  WallLoops(const Scene& scene, State& state, FibreHistory<T>& memory)
      : scene_(scene),
        state_(state),
        memory_(memory),
        step_(state.step == 0 ? 0.0 : scene.schedule.time_step),
        rule_(scene.section) {}

  [[nodiscard]] std::size_t element_count(std::size_t chunk) const {
    const std::span<const WallBlock> blocks = blocks_of(chunk);
    return blocks.back().first_element + blocks.back().walls * blocks.back().elements - blocks.front().first_element;
  }

  /// Start of the scratch of a chunk in that of all chunks.
  [[nodiscard]] T* scratch_of(LaneVector<T>& all, std::size_t chunk) const {
    return &all[kScratchKinds * blocks_of(chunk).front().first_element];
  }

  /// Returns whether any elements are squashed, so that their modulus is reduced.
  HWY_NOINLINE bool deform(std::size_t chunk, T* scratch) const {
    bool is_squashed = false;
    with_chunk(chunk, scratch, [&](auto& walls) HWY_ATTR {
      is_squashed = walls.deform();
      if (!state_.thickening_step.empty()) {
        state_.thickening_step[chunk] = walls.thickening_step();
      }
    });
    return is_squashed;
  }

  /// Returns the plastic work.
  HWY_NOINLINE double respond(std::size_t chunk, T* scratch, bool is_squashed) const {
    double work[kMostWallsInBlock] = {};
    with_chunk(chunk, scratch, [&](auto& walls) HWY_ATTR { walls.respond(is_squashed, work); });
    return sum_of(work);
  }

  /// Deforms and responds while the chunk is in the nearest cache. Returns the plastic work.
  double advance(std::size_t chunk, LaneVector<T>& scratch) const {
    scratch.resize(std::max(scratch.size(), kScratchKinds * element_count(chunk)));
    return respond(chunk, scratch.data(), deform(chunk, scratch.data()));
  }

 private:
  template <std::size_t kWidth>
  using Chunk = WallChunk<kForceBased, Law, Rule, WideTag<double, kWidth>, WideTag<T, kWidth>>;

  [[nodiscard]] std::span<const WallBlock> blocks_of(std::size_t chunk) const {
    const std::vector<int>& offset = scene_.walls.chunk_offset;
    return std::span(scene_.walls.blocks).subspan(offset[chunk], offset[chunk + 1] - offset[chunk]);
  }

  template <class Visit>
  HWY_INLINE void with_chunk(std::size_t chunk, T* scratch, const Visit& visit) const {
    const std::span<const WallBlock> blocks = blocks_of(chunk);
    if constexpr (Rule::kIsFixed) {
      if (blocks.front().walls == kMostWallsInBlock) {
        Chunk<kMostWallsInBlock> walls(scene_, state_, memory_, step_, rule_, blocks, scratch);
        visit(walls);
        return;
      }
    }
    Chunk<1> walls(scene_, state_, memory_, step_, rule_, blocks, scratch);
    visit(walls);
  }

  static double sum_of(const double (&work)[kMostWallsInBlock]) {
    return std::accumulate(work, work + kMostWallsInBlock, 0.0);
  }

  const Scene& scene_;
  State& state_;
  FibreHistory<T>& memory_;
  const double step_;
  const Rule rule_;
};

template <bool kForceBased, class Law, class T, class Use>
void with_rule(const Scene& scene, State& state, FibreHistory<T>& memory, const Use& use) {
  if constexpr (std::is_same_v<T, double>) {
    if (!has_known_counts(scene.section)) {
      use(WallLoops<kForceBased, Law, RuleFactors<0, 0, T>>(scene, state, memory));
      return;
    }
  }
  using Common = std::conditional_t<kForceBased, RuleFactors<4, 6, T>, RuleFactors<2, 6, T>>;
  use(WallLoops<kForceBased, Law, Common>(scene, state, memory));
}

template <class Law, class Use>
void with_precision(const Scene& scene, State& state, const Use& use) {
  if constexpr (Law::kFacts.may_be_single) {
    if (!scene.section.force_based && scene.single_fibres) {
      with_rule<false, Law>(scene, state, state.single_fibres, use);
      return;
    }
  }
  if (!scene.section.force_based) {
    with_rule<false, Law>(scene, state, state.fibres, use);
    return;
  }
  if constexpr (Law::kFacts.may_be_single_in_force_based) {
    if (scene.single_fibres) {
      with_rule<true, Law>(scene, state, state.single_fibres, use);
      return;
    }
  }
  with_rule<true, Law>(scene, state, state.fibres, use);
}

/// Calls use(loops) with the loops of the section rule, the law of the fibres and the precision of the scene.
template <class Use>
void with_loops(const Scene& scene, State& state, const Use& use) {
  Laws::visit(scene.law, [&](auto law) HWY_ATTR { with_precision<decltype(law)>(scene, state, use); });
}

/// Sums the forces on the joints between the chunks of two threads.
void sum_between_threads(const Scene& scene, State& state, const LatticeBand& band, const Workers& workers) {
  const auto chunks = static_cast<std::size_t>(band.end_chunk - band.first_chunk);
  for (int part = 1; part < workers.count(); ++part) {
    const std::size_t chunk = workers.start_of_part(chunks, part);
    if (chunk > 0 && chunk < chunks) {
      const std::size_t c = band.first_chunk + chunk;
      sum_joint_forces(scene, state, scene.walls.end_joint[c - 1], scene.walls.first_joint[c]);
    }
  }
}

/// The first joint summed by the thread whose chunks begin with number `first` of a band.
int first_joint_of(const Scene& scene, const LatticeBand& band, std::size_t first) {
  const std::size_t chunk = band.first_chunk + first;
  if (first > 0) {
    return scene.walls.first_joint[chunk];
  }
  return chunk > 0 ? scene.walls.end_joint[chunk - 1] : 0;
}

/// Forces on joints are summed as soon as all walls of the joint have been evaluated, while they are in the cache.
void evaluate_band(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                   Workers& workers, double* plastic_work) {
  const std::vector<int>& end_joint = scene.walls.end_joint;
  with_loops(scene, state, [&](const auto& loops) HWY_ATTR {
    using T = typename std::decay_t<decltype(loops)>::T;
    const auto advance = [&](std::size_t thread, std::size_t first, std::size_t end) HWY_ATTR {
      LaneVector<T>& scratch = workspace.of_thread[thread].template of<T>();
      int joint = first < end ? first_joint_of(scene, band, first) : 0;
      for (std::size_t c = band.first_chunk + first; c < band.first_chunk + end; ++c) {
        plastic_work[c] = loops.advance(c, scratch);
        sum_joint_forces(scene, state, joint, end_joint[c]);
        joint = std::max(joint, end_joint[c]);
      }
    };
    workers.parallel_ranges(static_cast<std::size_t>(band.end_chunk - band.first_chunk), 1, advance);
  });
  sum_between_threads(scene, state, band, workers);
}

void deform_all(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers) {
  with_loops(scene, state, [&](const auto& loops) HWY_ATTR {
    using T = typename std::decay_t<decltype(loops)>::T;
    LaneVector<T>& scratch = workspace.all.template of<T>();
    scratch.resize(kScratchKinds * scene.element_count());
    workers.parallel_for(workspace.squashed.size(), [&](std::size_t first, std::size_t end) HWY_ATTR {
      for (std::size_t c = first; c < end; ++c) {
        workspace.squashed[c] = loops.deform(c, loops.scratch_of(scratch, c)) ? 1 : 0;
      }
    });
  });
}

void respond_piece(const Scene& scene, State& state, WallsWorkspace& workspace, std::size_t piece,
                   double* plastic_work) {
  with_loops(scene, state, [&](const auto& loops) HWY_ATTR {
    using T = typename std::decay_t<decltype(loops)>::T;
    LaneVector<T>& scratch = workspace.all.template of<T>();
    const std::size_t end = std::min(workspace.squashed.size(), (piece + 1) * kChunksInPiece);
    for (std::size_t c = piece * kChunksInPiece; c < end; ++c) {
      plastic_work[c] = loops.respond(c, loops.scratch_of(scratch, c), workspace.squashed[c] != 0);
    }
  });
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_band);
HWY_EXPORT(deform_all);
HWY_EXPORT(respond_piece);

void size_thickening_step(const Scene& scene, State& state) {
  if (scene.thickens()) {
    state.thickening_step.resize(static_cast<std::size_t>(scene.walls.chunk_count()), 0.0);
  }
}

void evaluate_internal_forces(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                              Workers& workers, double* plastic_work) {
  workspace.of_thread.resize(static_cast<std::size_t>(workers.count()));
  HWY_DYNAMIC_DISPATCH(evaluate_band)(scene, state, band, workspace, workers, plastic_work);
}

void deform_walls(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers) {
  workspace.squashed.resize(static_cast<std::size_t>(scene.walls.chunk_count()));
  HWY_DYNAMIC_DISPATCH(deform_all)(scene, state, workspace, workers);
}

std::size_t wall_piece_count(const Scene& scene) {
  return (static_cast<std::size_t>(scene.walls.chunk_count()) + kChunksInPiece - 1) / kChunksInPiece;
}

void respond_walls(const Scene& scene, State& state, WallsWorkspace& workspace, std::size_t piece,
                   double* plastic_work) {
  HWY_DYNAMIC_DISPATCH(respond_piece)(scene, state, workspace, piece, plastic_work);
}

void sum_joint_forces(const Scene& scene, State& state, std::size_t first, std::size_t end) {
  // Raw pointers: a store may alias a vector's own pointer.
  const int* const offsets = scene.wall_end_offset.data();
  const int* const wall_ends = scene.wall_ends.data();
  const Vector2* const forces = state.wall_force.data();
  const double* const moments = state.wall_moment.data();
  Vector2* const sums = state.internal_force.data();
  double* const sums_of_moments = state.internal_moment.data();
  for (std::size_t joint = first; joint < end; ++joint) {
    const int* ends = wall_ends + offsets[joint];
    const int count = offsets[joint + 1] - offsets[joint];
    Vector2 force = Vector2::Zero();
    double moment = 0.0;
    // Most joints of a honeycomb have three walls. Without a loop these take half of the time.
    if (count == 3) {
      force = forces[ends[0]] + forces[ends[1]] + forces[ends[2]];
      moment = moments[ends[0]] + moments[ends[1]] + moments[ends[2]];
    } else {
      for (int k = 0; k < count; ++k) {
        force += forces[ends[k]];
        moment += moments[ends[k]];
      }
    }
    sums[joint] = force;
    sums_of_moments[joint] = moment;
  }
}

void sum_joint_forces(const Scene& scene, State& state, Workers& workers) {
  workers.parallel_for(static_cast<std::size_t>(scene.joint_count),
                       [&](std::size_t first, std::size_t end) { sum_joint_forces(scene, state, first, end); });
}

}  // namespace cellcrush
#endif
