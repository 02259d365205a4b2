#pragma once

#include <vector>

#include "cellcrush/scene_spec.h"
#include "lattice/cut_walls.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Factors along an axis, as steps or as a polynomial, of a share from 0 to 1.
class Factors {
 public:
  /// At most one is not empty.
  Factors(const std::vector<double>& steps, const std::vector<double>& polynomial)
      : steps_(&steps), polynomial_(&polynomial) {}

  [[nodiscard]] bool are_given() const { return !steps_->empty() || !polynomial_->empty(); }

  /// At a share; outside, that of the nearer end.
  [[nodiscard]] double at(double share) const;

  /// Their integral from 0 to a share, continued beyond both ends.
  [[nodiscard]] double up_to(double share) const;

 private:
  const std::vector<double>* steps_;
  const std::vector<double>* polynomial_;
};

inline Factors thickness_factors(const Grading& grading) {
  return {grading.thickness_steps, grading.thickness_polynomial};
}
inline Factors size_factors(const Grading& grading) { return {grading.size_steps, grading.size_polynomial}; }

/// Moves the joints along the axis of the grading, so that the sizes of cells that were even are in the ratio of the
/// factors. The ends of the box stay. The rise of an arc changes with its chord.
void grade_sizes(const Grading& grading, const Box& box, Layout& layout);

/// Multiplies the thickness of each wall by the factor at its middle, and all by one more, so that the mean thickness
/// over the length of the walls stays.
void grade_thicknesses(const Grading& grading, const Box& box, Layout& layout);

}  // namespace cellcrush
