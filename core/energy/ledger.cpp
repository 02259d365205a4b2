#include "energy/ledger.h"

#include <algorithm>
#include <span>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "energy/ledger.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/cross_section-inl.h"
#include "beam/element_place.h"
#include "motion/integrate_motion.h"
#include "motion/motion_works-inl.h"
#include "motion/particle_motion-inl.h"
#include "motion/periodic_sides.h"
#include "motion/rigid_motion.h"
#include "push/push.h"
#include "section/section_rule.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Works on some free particles that are moved together.
MotionWorks works_of_particles(const Scene& scene, const State& state, std::size_t begin, std::size_t end) {
  const StepFactors step = step_factors_of(scene);
  const ParticleArrays<const State> arrays(scene, state);
  MotionWorks sum;
  with_force_kinds(scene, state, [&](auto kinds) HWY_ATTR {
    using Kinds = decltype(kinds);
    constexpr std::size_t kWidth = Kinds::kFrame ? 1 : kSumLanes;
    sum = sum_works<kWidth>(begin, end, [&](auto d, std::size_t i, auto& works) HWY_ATTR {
      const auto forces = forces_on<true, Kinds, decltype(d)>(arrays, i);
      add_works_of_half_step<Kinds>(arrays, step, i, forces, motion_of<Kinds>(arrays, step, forces, i), works);
    });
  });
  return sum;
}

/// Elastic energy, lane by lane: elements in lanes D, their fibres in lanes F.
template <class D, class F>
class LaneEnergy {
  using T = hn::TFromD<F>;

 public:
  LaneEnergy(const Scene& scene, const State& state, const FibreHistory<T>& memory)
      : scene_(scene), state_(state), memory_(memory) {
    for (const double along : scene.section.along_weight) {
      for (const double through : scene.section.depth_weight) {
        weight_[fibres_++] = static_cast<T>(along * through);
      }
    }
  }

  /// Adds that of a row of elements to the walls of the lanes.
  HWY_INLINE void add_row(const WallBlock& block, std::size_t row, double* HWY_RESTRICT energy) const {
    T squares[kMostWallsInBlock];
    for (int lane = 0; lane < block.walls; lane += static_cast<int>(Lane<F>::kWidth)) {
      weighted_squares(&memory_.stress[row * fibres_] + lane, block.walls).store(squares + lane);
    }
    for (int lane = 0; lane < block.walls; lane += static_cast<int>(Lane<D>::kWidth)) {
      const Lane<D> of_lanes = energy_of(block, lane, row + lane, Lane<D>::load(squares + lane));
      (Lane<D>::load(energy + lane) + of_lanes).store(energy + lane);
    }
  }

 private:
  /// Weighted squares of the stresses of the elements of the lanes; `stride` elements lie side by side for each fibre.
  HWY_INLINE Lane<F> weighted_squares(const T* HWY_RESTRICT stress, int stride) const {
    Lane<F> squares = 0;
    for (std::size_t fibre = 0; fibre < fibres_; ++fibre) {
      const Lane<F> of_fibre = Lane<F>::load(stress);
      squares = fma(Lane<F>(weight_[fibre]) * of_fibre, of_fibre, squares);
      stress += stride;
    }
    return squares;
  }

  HWY_INLINE Lane<D> energy_of(const WallBlock& block, int lane, std::size_t element, Lane<D> squares) const {
    const CrossSection<D> section(scene_, block, lane);
    const Lane<D> shortening = Lane<D>::load(&state_.shortening[element]);
    Lane<D> modulus = section.modulus();
    if (HWY_UNLIKELY(any(section.is_squashed(shortening)))) {
      modulus = modulus * section.modulus_share(shortening, section.thickening(shortening));
    }
    if (!scene_.walls.shear.empty()) {  // E5i
      const Lane<D> sheared = Lane<D>::load(&memory_.shear[element]);
      squares = fma(Lane<D>::load(&scene_.walls.shear[section.wall]) * sheared, sheared, squares);
    }
    return section.volume() * squares / (modulus + modulus);
  }

  const Scene& scene_;
  const State& state_;
  const FibreHistory<T>& memory_;
  T weight_[kMostSections * kMostDepthPoints];  ///< of each fibre, in the integral over section and element
  std::size_t fibres_ = 0;
};

template <class T>
double energy_of_memory(const Scene& scene, const State& state, const FibreHistory<T>& memory,
                        std::span<const WallBlock> blocks) {
  using Wide = LaneEnergy<WideTag<double, kMostWallsInBlock>, WideTag<T, kMostWallsInBlock>>;
  using One = LaneEnergy<hn::CappedTag<double, 1>, hn::CappedTag<T, 1>>;
  const Wide wide(scene, state, memory);
  const One one(scene, state, memory);
  double energy[kMostWallsInBlock] = {};
  visit_rows(blocks, [&](const WallBlock& block, std::size_t row) HWY_ATTR {
    if (block.walls == kMostWallsInBlock) {
      wide.add_row(block, row, energy);
    } else {
      one.add_row(block, row, energy);
    }
  });
  double sum = 0.0;
  for (const double of_lane : energy) {
    sum += of_lane;
  }
  return sum;
}

double energy_of_walls(const Scene& scene, const State& state, std::span<const WallBlock> blocks) {
  return scene.single_fibres ? energy_of_memory(scene, state, state.single_fibres, blocks)
                             : energy_of_memory(scene, state, state.fibres, blocks);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(works_of_particles);
HWY_EXPORT(energy_of_walls);

namespace {

MotionWorks works_of_chunk(const Scene& scene, const State& state, std::size_t chunk) {
  const auto [first, end] = moved_chunk(scene, chunk);
  return HWY_DYNAMIC_DISPATCH(works_of_particles)(scene, state, first, end);
}

/// The works of the newest forces over the half step up to the time of the state, and twice the kinetic energy at that
/// time.
MotionWorks works_of_half_step(const Scene& scene, const State& state, std::span<const MotionWorks> of_particles) {
  MotionWorks works = half_step_works_of_rigid_bodies(scene, state);
  MotionWorks free;
  for (const MotionWorks& chunk : of_particles) free.add(chunk);
  works.add(free);
  for (const Pusher* pusher : pushers()) {
    works.add(pusher->half_step_works(scene, state));
  }
  works.add(half_step_works_of_sides(scene, state));
  return works;
}

}  // namespace

void open_ledger(const Scene& scene, State& state) {
  std::vector<MotionWorks> of_particles(moved_chunk_count(scene));
  for (std::size_t i = 0; i < of_particles.size(); ++i) of_particles[i] = works_of_chunk(scene, state, i);
  const MotionWorks start = works_of_half_step(scene, state, of_particles);
  start.accumulate(state.ledger, -1.0);
  state.ledger.initial = 0.5 * start.twice_kinetic;
}

EnergyPieces::EnergyPieces(const Scene& scene, const State& state)
    : scene_(scene),
      state_(state),
      walls_(sampled_pieces(scene.walls.blocks.size())),
      particles_(moved_chunk_count(scene)) {}

std::size_t EnergyPieces::count() const { return walls_.size() + sampled_pieces(particles_.size()); }

void EnergyPieces::evaluate(std::size_t piece) {
  if (piece < walls_.size()) {
    walls_[piece] = HWY_DYNAMIC_DISPATCH(energy_of_walls)(scene_, state_, sampled_piece(scene_.walls.blocks, piece));
    return;
  }
  const std::size_t first = (piece - walls_.size()) * kSampledTogether;
  for (std::size_t chunk = first; chunk < std::min(first + kSampledTogether, particles_.size()); ++chunk) {
    particles_[chunk] = works_of_chunk(scene_, state_, chunk);
  }
}

Energies EnergyPieces::total() const {
  const MotionWorks newest = works_of_half_step(scene_, state_, particles_);
  Energies now{state_.ledger};
  newest.accumulate(now);
  now.kinetic = 0.5 * newest.twice_kinetic;
  for (const double of_blocks : walls_) now.elastic += of_blocks;
  for (const Break& broken : state_.breaks) now.fracture += broken.released;
  now.residual = residual_of(now);
  return now;
}

Energies evaluate_energies(const Scene& scene, const State& state) {
  EnergyPieces pieces(scene, state);
  for (std::size_t i = 0; i < pieces.count(); ++i) pieces.evaluate(i);
  return pieces.total();
}

}  // namespace cellcrush
#endif
