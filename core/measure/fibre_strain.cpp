#include "measure/fibre_strain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/vector.h"

namespace cellcrush {
namespace {

/// The same angle in [-pi, pi].
double least_angle(double angle) {
  return std::abs(angle) <= std::numbers::pi ? angle : std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The walls of a block, at one time.
class BlockStrains {
 public:
  BlockStrains(const Scene& scene, const State& state, const WallBlock& block)
      : scene_(scene),
        state_(state),
        block_(block),
        together_(scene.section.force_based && block.has_pairs() ? 2 : 1) {}

  [[nodiscard]] double of_wall(int w) const {
    double largest = 0.0;
    for (int j = 0; j < block_.elements; j += together_) {
      const double strain = together_ == 2 ? of_pair(element(j, w), element(j + 1, w)) : of_single(element(j, w));
      largest = std::max(largest, strain);  // a value that is not finite is none
    }
    return largest;
  }

 private:
  /// An element without its rigid motion.
  struct Strained {
    std::size_t index;
    double turn;            ///< of the axis since the start, in [-pi, pi]
    double axial;           ///< strain
    double inverse_length;  ///< 1 / L, without elastic strain (E5c)
    double half_thickness;  ///< mm, before loading
    double sheared;         ///< turn of both ends by shear (E5i)

    [[nodiscard]] double outer(double curvature) const {
      return std::abs(axial) + half_thickness * std::abs(curvature);
    }
  };

  [[nodiscard]] Strained element(int j, int w) const {
    const std::size_t index = block_.first_element + static_cast<std::size_t>(j) * block_.walls + w;
    const Element& element = scene_.elements[index];
    const Vector2 before = scene_.position[element.end] - scene_.position[element.start];
    const double shortening = scene_.constant_area ? 1.0 : state_.shortening[index];
    const double inverse_length = shortening / before.norm();
    const double lost = shortening > 1.0 ? std::log(shortening) : 0.0;
    return {index,
            std::atan2(cross(before, state_.axis[index]), before.dot(state_.axis[index])),
            state_.length[index] * inverse_length - 1.0 - lost,
            inverse_length,
            0.5 * element.thickness,
            scene_.walls.shear.empty() ? 0.0 : sheared_turn(index, j, w, inverse_length)};
  }

  /// From the left moment less the right one, over A gamma: the outer one is the right one of the second of a pair.
  [[nodiscard]] double sheared_turn(std::size_t index, int j, int w, double inverse_length) const {
    const double borne = scene_.single_fibres ? state_.single_fibres.shear[index] : state_.fibres.shear[index];
    const Element& element = scene_.elements[index];
    const double gyration = element.thickness / std::sqrt(12.0);
    const double left_less_right = j % together_ == 0 ? borne : -borne;
    return scene_.walls.shear[block_.first_wall + w] * left_less_right /
           (scene_.materials[element.material].youngs_modulus * gyration * inverse_length);
  }

  /// theta_1 and theta_2 of E4, since the start, without what is shear.
  [[nodiscard]] double turn_at_start(const Strained& of) const {
    return least_angle(state_.rotation[scene_.elements[of.index].start] - of.turn) - of.sheared;
  }
  [[nodiscard]] double turn_at_end(const Strained& of) const {
    return least_angle(state_.rotation[scene_.elements[of.index].end] - of.turn) - of.sheared;
  }

  [[nodiscard]] double of_single(const Strained& of) const {
    const double start = turn_at_start(of);
    const double end = turn_at_end(of);
    const double turns = std::max(std::abs(4.0 * start + 2.0 * end), std::abs(2.0 * start + 4.0 * end));
    return of.outer(turns * of.inverse_length);
  }

  [[nodiscard]] double of_pair(const Strained& left, const Strained& right) const {
    const double start = turn_at_start(left);
    const double end = turn_at_end(right);
    const double between = least_angle(right.turn - left.turn) + right.sheared - left.sheared;
    const double middle =
        (4.0 * between + 2.0 * (start - end)) / (1.0 / left.inverse_length + 1.0 / right.inverse_length);
    return std::max({left.outer(3.0 * start * left.inverse_length + 0.5 * middle), left.outer(middle),
                     right.outer(3.0 * end * right.inverse_length - 0.5 * middle), right.outer(middle)});
  }

  const Scene& scene_;
  const State& state_;
  const WallBlock& block_;
  const int together_;  // elements that are solved together (E5b)
};

template <class Visit>
void visit_walls(const Scene& scene, const State& state, std::span<const WallBlock> blocks, const Visit& visit) {
  for (const WallBlock& block : blocks) {
    const BlockStrains strains(scene, state, block);
    for (int w = 0; w < block.walls; ++w) visit(block.first_wall + w, strains.of_wall(w));
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
