#include "measure/fibre_strain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "measure/fibre_strain.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/deformation-inl.h"
#include "cellcrush/vector.h"
#include "simd/lane-inl.h"
#include "simd/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// The same angle in [-pi, pi].
template <class D>
HWY_INLINE Lane<D> least_angle(Lane<D> angle) {
  const Lane<D> turns = hn::Round((angle * Lane<D>(0.5 / std::numbers::pi)).raw);
  return fnma(turns, Lane<D>(2.0 * std::numbers::pi), angle);
}

/// ln of numbers of at least 1. Most exceed it by little, where a series gives all digits.
template <class D>
HWY_INLINE Lane<D> log_of(Lane<D> number) {
  constexpr double kSmall = 1.02;  // the first omitted term is below 1e-17 of the logarithm
  const Lane<D> one = 1;
  if (HWY_LIKELY(all(number < Lane<D>(kSmall)))) {
    const Lane<D> half = (number - one) / (number + one);
    const Lane<D> square = half * half;
    const Lane<D> series = fma(square, fma(square, 1.0 / 7.0, 1.0 / 5.0), 1.0 / 3.0);
    return Lane<D>(2) * fma(half * square, series, half);
  }
  double values[Lane<D>::kWidth];
  number.store(values);
  for (double& value : values) value = std::log(value);
  return Lane<D>::load(values);
}

/// The walls of a block from `lane` on, at one time.
template <class D>
class WallStrains {
  using Real = Lane<D>;

 public:
  WallStrains(const Scene& scene, const State& state, const WallBlock& block, int lane)
      : scene_(scene),
        state_(state),
        block_(block),
        lane_(lane),
        half_thickness_(Real(0.5) * Real::load(&scene.walls.thickness[block.first_wall + lane])),
        has_pairs_(scene.section.force_based && block.has_pairs()) {}

  HWY_INLINE Real largest() const {
    Real largest = 0;
    for (int j = 0; j < block_.elements; j += has_pairs_ ? 2 : 1) {
      const Real strain = has_pairs_ ? of_pair(element(j), element(j + 1)) : of_single(element(j));
      largest = select(strain > largest, strain, largest);  // a value that is not finite is none
    }
    return largest;
  }

 private:
  /// Elements without their rigid motion.
  struct Strained {
    Real turn_at_start;   ///< theta_1 of E4, since the start, without what is shear
    Real turn_at_end;     ///< theta_2
    Real turn;            ///< of the axis since the start, in [-pi, pi]
    Real axial;           ///< strain
    Real inverse_length;  ///< 1 / L, without elastic strain (E5c)
    Real sheared;         ///< turn of both ends by shear (E5i)
  };

  /// Particles before and after element j: joints at the ends of the walls, others side by side.
  HWY_INLINE Points<D> start_of(const Vector2* positions, int j) const {
    return j == 0 ? gather<D>(positions, &scene_.walls.start[block_.first_wall + lane_])
                  : Points<D>::load(positions + inner(j - 1));
  }
  HWY_INLINE Points<D> end_of(const Vector2* positions, int j) const {
    return j + 1 == block_.elements ? gather<D>(positions, &scene_.walls.end[block_.first_wall + lane_])
                                    : Points<D>::load(positions + inner(j));
  }
  HWY_INLINE Real rotation_before(int j) const {
    const double* const rotations = state_.rotation.data();
    return j == 0 ? gather<D>(rotations, &scene_.walls.start[block_.first_wall + lane_])
                  : Real::load(rotations + inner(j - 1));
  }
  HWY_INLINE Real rotation_after(int j) const {
    const double* const rotations = state_.rotation.data();
    return j + 1 == block_.elements ? gather<D>(rotations, &scene_.walls.end[block_.first_wall + lane_])
                                    : Real::load(rotations + inner(j));
  }
  [[nodiscard]] std::ptrdiff_t inner(int j) const {
    return block_.first_inner + static_cast<std::ptrdiff_t>(j) * block_.walls + lane_;
  }

  HWY_INLINE Strained element(int j) const {
    const std::size_t index = block_.first_element + static_cast<std::size_t>(j) * block_.walls + lane_;
    const Points<D> before = end_of(scene_.position.data(), j) - start_of(scene_.position.data(), j);
    const Points<D> axis = Points<D>::load(&state_.axis[index]);
    const Real one = 1;
    const Real inverse_before = one / sqrt(dot(before, before));
    const Real shortening = scene_.constant_area ? one : Real::load(&state_.shortening[index]);
    Strained of;
    of.inverse_length = shortening * inverse_before;
    of.axial = fms(Real::load(&state_.length[index]), of.inverse_length, one);
    if (HWY_UNLIKELY(any(shortening > one))) of.axial -= log_of(shortening);
    of.turn = angle_of(cross(before, axis) * inverse_before, dot(before, axis) * inverse_before);
    of.sheared = scene_.walls.shear.empty() ? Real(0) : sheared_turn(index, j, of.inverse_length);
    of.turn_at_start = least_angle(rotation_before(j) - of.turn) - of.sheared;
    of.turn_at_end = least_angle(rotation_after(j) - of.turn) - of.sheared;
    return of;
  }

  /// From the left moment less the right one, over A gamma: the outer one is the right one of the second of a pair.
  HWY_INLINE Real sheared_turn(std::size_t index, int j, Real inverse_length) const {
    const int wall = block_.first_wall + lane_;
    const Real borne =
        scene_.single_fibres ? Real::load(&state_.single_fibres.shear[index]) : Real::load(&state_.fibres.shear[index]);
    const Real left_less_right = has_pairs_ && j % 2 != 0 ? -borne : borne;
    double moduli[Real::kWidth];
    for (std::size_t i = 0; i < Real::kWidth; ++i) {
      moduli[i] = scene_.materials[scene_.walls.material[wall + i]].youngs_modulus;
    }
    const Real gyration = half_thickness_ * Real(1.0 / std::numbers::sqrt3);
    return Real::load(&scene_.walls.shear[wall]) * left_less_right / (Real::load(moduli) * gyration * inverse_length);
  }

  HWY_INLINE Real outer(const Strained& of, Real curvature) const {
    return fma(half_thickness_, abs(curvature), abs(of.axial));
  }

  HWY_INLINE Real of_single(const Strained& of) const {
    const Real two = 2;
    const Real start = of.turn_at_start;
    const Real end = of.turn_at_end;
    const Real turns = max(abs(two * start + end), abs(fma(two, end, start)));
    return outer(of, two * turns * of.inverse_length);
  }

  HWY_INLINE Real of_pair(const Strained& left, const Strained& right) const {
    const Real start = left.turn_at_start;
    const Real end = right.turn_at_end;
    const Real between = least_angle(right.turn - left.turn) + right.sheared - left.sheared;
    const Real middle = fma(Real(4), between, Real(2) * (start - end)) * left.inverse_length * right.inverse_length /
                        (left.inverse_length + right.inverse_length);
    const Real at_start = fma(Real(3) * start, left.inverse_length, Real(0.5) * middle);
    const Real at_end = fms(Real(3) * end, right.inverse_length, Real(0.5) * middle);
    return max(max(outer(left, at_start), outer(left, middle)), max(outer(right, at_end), outer(right, middle)));
  }

  const Scene& scene_;
  const State& state_;
  const WallBlock& block_;
  const int lane_;
  const Real half_thickness_;  // mm, before loading
  const bool has_pairs_;       // elements are solved together (E5b)
};

template <class D>
void put_strains(const Scene& scene, const State& state, const WallBlock& block, double* strains) {
  for (int lane = 0; lane < block.walls; lane += static_cast<int>(Lane<D>::kWidth)) {
    WallStrains<D>(scene, state, block, lane).largest().store(strains + lane);
  }
}

/// Writes the largest strain of each wall of a block.
void strains_of_block(const Scene& scene, const State& state, const WallBlock& block, double* strains) {
  if (block.walls == kMostWallsInBlock) {
    put_strains<WideTag<double, kMostWallsInBlock>>(scene, state, block, strains);
  } else {
    put_strains<hn::CappedTag<double, 1>>(scene, state, block, strains);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(strains_of_block);

namespace {

template <class Visit>
void visit_walls(const Scene& scene, const State& state, std::span<const WallBlock> blocks, const Visit& visit) {
  double strains[kMostWallsInBlock];
  for (const WallBlock& block : blocks) {
    HWY_DYNAMIC_DISPATCH(strains_of_block)(scene, state, block, strains);
    for (int w = 0; w < block.walls; ++w) visit(block.first_wall + w, strains[w]);
  }
}

}  // namespace

WallStrain find_largest_fibre_strain(const Scene& scene, const State& state, std::span<const WallBlock> blocks) {
  WallStrain largest;
  visit_walls(scene, state, blocks, [&largest](int wall, double strain) {
    if (strain > largest.strain) largest = {strain, wall};
  });
  return largest;
}

void evaluate_fibre_strains(const Scene& scene, const State& state, std::vector<float>& strains) {
  strains.assign(scene.wall_count(), 0.0F);
  visit_walls(scene, state, scene.walls.blocks, [&](int wall, double strain) {
    float& of_wall = strains[scene.list_order.listed_wall(wall)];
    of_wall = std::max(of_wall, static_cast<float>(strain));
  });
}

}  // namespace cellcrush
#endif
