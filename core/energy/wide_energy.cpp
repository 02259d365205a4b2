#include "energy/wide_energy.h"

#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "energy/wide_energy.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/element_place.h"
#include "beam/wall_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Elastic energy, each lane's by itself: elements in lanes D, their fibres in lanes F.
template <class D, class F>
class LaneEnergy {
  using V = hn::Vec<D>;
  using T = hn::TFromD<F>;

 public:
  LaneEnergy(const Scene& scene, const State& state, const FibreMemory<T>& memory)
      : scene_(scene), state_(state), memory_(memory) {
    for (const double along : scene.section.along_weight) {
      for (const double through : scene.section.depth_weight) {
        weight_.push_back(static_cast<T>(along * through));
      }
    }
  }

  /// Adds that of the elements at the same place of a block's walls to the walls' lanes.
  HWY_INLINE void add_row(const WallBlock& block, std::size_t row, double* HWY_RESTRICT energy) const {
    T squares[kMostWallsInBlock];
    for (int lane = 0; lane < block.walls; lane += static_cast<int>(hn::MaxLanes(f_))) {
      hn::StoreU(weighted_squares(&memory_.stress[row * weight_.size()] + lane, block.walls), f_, squares + lane);
    }
    for (int lane = 0; lane < block.walls; lane += static_cast<int>(hn::MaxLanes(d_))) {
      const V of_lanes = energy_of(block.first_wall + lane, row + lane, load_as(d_, squares + lane));
      hn::StoreU(hn::Add(hn::LoadU(d_, energy + lane), of_lanes), d_, energy + lane);
    }
  }

 private:
  /// Squares of the stresses of the lanes' elements, of which `stride` lie side by side for each fibre.
  HWY_INLINE hn::Vec<F> weighted_squares(const T* HWY_RESTRICT stress, int stride) const {
    auto squares = hn::Zero(f_);
    for (const T weight : weight_) {
      const auto of_fibre = hn::LoadU(f_, stress);
      squares = hn::MulAdd(hn::Mul(hn::Set(f_, weight), of_fibre), of_fibre, squares);
      stress += stride;
    }
    return squares;
  }

  HWY_INLINE V energy_of(int wall, std::size_t element, V squares) const {
    const V thickness = hn::LoadU(d_, &scene_.walls.thickness[wall]);
    const V undeformed = hn::LoadU(d_, &scene_.walls.undeformed_length[wall]);
    const V length = hn::LoadU(d_, &state_.length[element]);
    V modulus = modulus_of(wall);
    if (HWY_UNLIKELY(!hn::AllFalse(d_, is_short(d_, length, undeformed)))) {
      modulus = hn::Mul(modulus, bounded_stiffness(d_, length, undeformed, thickness, scene_.constant_area));
    }
    return hn::Div(hn::Mul(volume_of(d_, scene_, undeformed, thickness, length), squares), hn::Add(modulus, modulus));
  }

  HWY_INLINE V modulus_of(int wall) const {
    if (scene_.materials.size() == 1) {
      return hn::Set(d_, scene_.materials.front().youngs_modulus);
    }
    double values[kMostWallsInBlock];
    for (std::size_t lane = 0; lane < hn::MaxLanes(d_); ++lane) {
      values[lane] = scene_.materials[scene_.walls.material[wall + lane]].youngs_modulus;
    }
    return hn::LoadU(d_, values);
  }

  static constexpr D d_{};
  static constexpr F f_{};
  const Scene& scene_;
  const State& state_;
  const FibreMemory<T>& memory_;
  std::vector<T> weight_;  ///< of each fibre, in the section's integral along the element
};

template <class T>
double energy_of_memory(const Scene& scene, const State& state, const FibreMemory<T>& memory) {
  using Wide = LaneEnergy<hn::CappedTag<double, kMostWallsInBlock>, hn::CappedTag<T, kMostWallsInBlock>>;
  using One = LaneEnergy<hn::CappedTag<double, 1>, hn::CappedTag<T, 1>>;
  const Wide wide(scene, state, memory);
  const One one(scene, state, memory);
  double energy[kMostWallsInBlock] = {};
  visit_rows(scene, [&](const WallBlock& block, std::size_t row) HWY_ATTR {
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

double elastic_energy(const Scene& scene, const State& state) {
  return scene.single_fibres ? energy_of_memory(scene, state, state.single_fibres)
                             : energy_of_memory(scene, state, state.fibres);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(elastic_energy);

double elastic_energy_wide(const Scene& scene, const State& state) {
  return HWY_DYNAMIC_DISPATCH(elastic_energy)(scene, state);
}

}  // namespace cellcrush
#endif
