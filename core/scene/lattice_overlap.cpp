#include "scene/lattice_overlap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/bucket_grid.h"
#include "contact/initial_overlap.h"
#include "contact/wall_paths.h"

namespace cellcrush {
namespace {

using Cell = LatticeShape::Cell;
using std::numbers::pi;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

/// Share by which a bound must be kept, far above what round-off makes of the numbers that it bounds.
constexpr double kMargin = 1e-6;

/// A lattice with walls of length 1. The diamond of a wall has its ends and the middles of the cells beside it for corners; no
/// two overlap.
struct CellFacts {
  double angle;             ///< between neighbouring walls at a joint, rad
  double walls_at_a_joint;  ///< at most
  double clearance;         ///< of walls that do not meet
  double diamond;           ///< area of a wall's diamond
  double diamond_length;    ///< of the longer diagonal
};

CellFacts facts_of_cell(Cell cell) {
  switch (cell) {
    case Cell::hexagon: return {2.0 * pi / 3.0, 3.0, 1.0, 0.5 * sqrt3, sqrt3};
    case Cell::square: return {0.5 * pi, 4.0, 1.0, 0.5, 1.0};
    case Cell::triangle: break;
  }
  return {pi / 3.0, 6.0, 0.5 * sqrt3, 0.5 / sqrt3, 1.0};
}

/// Lengths in walls' lengths L.
class OverlapBounds {
 public:
  OverlapBounds(const RegularLattice& lattice, double thickest, double amplitude, std::size_t particles,
                std::size_t elements)
      : cell_(facts_of_cell(lattice.shape.cell)),
        envelope_(envelope_of(lattice) / lattice.sizes.side),
        elements_a_wall_(lattice.sizes.elements_per_wall),
        thickest_(thickest / lattice.sizes.side),
        moved_(sqrt2 * amplitude / lattice.sizes.side),
        particles_(static_cast<double>(particles)),
        elements_(static_cast<double>(elements)) {
    const double turned = 2.0 * std::asin(2.0 * moved_);  // by both of the walls
    angle_ = cell_.angle - turned;
    shortest_ = (1.0 - 2.0 * moved_) / elements_a_wall_;
    const double parts = lattice.sizes.rigid && !lattice.shape.stiff_rows.empty() ? 1.0 : elements_a_wall_;
    longest_ = (1.0 + 2.0 * moved_) / parts;
  }

  [[nodiscard]] bool are_walls_apart() const {
    const bool far = cell_.clearance - 2.0 * moved_ > (1.0 + kMargin) * thickest_;
    const bool wide = std::sin(0.5 * angle_) > (1.0 + kMargin) * WallPaths::kTouchingShare;
    const bool thin = shortest_ * std::sin(std::min(angle_, 0.5 * pi)) > (1.0 + kMargin) * thickest_;
    return far && (wide || thin);
  }

  /// Near balls of a segment are in its own wall, or in one that meets it.
  [[nodiscard]] bool are_few_near() const {
    const double along = balls_within(thickest_);
    const double beside = balls_within(thickest_ / std::sin(0.5 * angle_));
    const double near = 2.0 * along + neighbours() * beside;
    return elements_ * near < (1.0 - kMargin) * kMostNearSegments * particles_;
  }

  [[nodiscard]] bool are_few_visited() const {
    const double margin = thickest_ + bucket_size(longest_ + 0.5 * thickest_, particles_);
    const double balls = walls_within(margin) * std::min(elements_a_wall_ + 1.0, points_within(margin, shortest_));
    // Marks are half of an element apart, or more.
    const double mark_margin = 0.5 * longest_ + bucket_size(longest_, elements_);
    const double marks =
        walls_within(mark_margin) * std::min(2.0 * elements_a_wall_, points_within(mark_margin, 0.5 * shortest_));
    return elements_ * (2.0 * balls + marks) < (1.0 - kMargin) * kMostOverlapVisits * (elements_ + particles_);
  }

 private:
  [[nodiscard]] double neighbours() const { return 2.0 * (cell_.walls_at_a_joint - 1.0); }

  /// Particles of a wall, but for the first, within a way from its end.
  [[nodiscard]] double balls_within(double way) const {
    return std::min(elements_a_wall_, std::floor(way / shortest_ + 1.0));
  }

  /// Largest side of a bucket when `size` is asked for: the least with which there are few enough of them, or twice that.
  [[nodiscard]] double bucket_size(double size, double points) const {
    const double width = envelope_.x() + 2.0 * moved_;
    const double height = envelope_.y() + 2.0 * moved_;
    const double most = BucketGrid::kBucketsPerPoint * points + 15.0;
    const double half = width + height;
    const double least = (half + std::sqrt(half * half + 4.0 * most * width * height)) / (2.0 * most);
    return std::max(size, 2.0 * least);
  }

  /// Side of the box round an element with a margin.
  [[nodiscard]] double box_side(double margin) const { return longest_ + 2.0 * margin; }

  /// Walls that have a point in such a box: those that meet the element's, or as many as have room for their diamonds.
  [[nodiscard]] double walls_within(double margin) const {
    if ((1.0 + kMargin) * (sqrt2 * margin + 0.5 * longest_) < cell_.clearance - 2.0 * moved_) {
      return 1.0 + neighbours();
    }
    const double side = box_side(margin) + 2.0 * moved_ + 2.0 * cell_.diamond_length;
    return side * side / cell_.diamond;
  }

  /// Points of one straight wall in such a box.
  [[nodiscard]] double points_within(double margin, double spacing) const {
    return sqrt2 * box_side(margin) / spacing + 1.0;
  }

  CellFacts cell_;
  Vector2 envelope_;
  double elements_a_wall_;
  double thickest_;
  double moved_;  // how far a point may be moved
  double particles_;
  double elements_;
  double angle_ = 0.0;     // least between walls that meet
  double shortest_ = 0.0;  // element
  double longest_ = 0.0;   // element
};

}  // namespace

bool is_free_of_overlap(const RegularLattice& lattice, double thickest, double amplitude, std::size_t particles,
                        std::size_t elements) {
  const OverlapBounds bounds(lattice, thickest, amplitude, particles, elements);
  return bounds.are_walls_apart() && bounds.are_few_near() && bounds.are_few_visited();
}

}  // namespace cellcrush
