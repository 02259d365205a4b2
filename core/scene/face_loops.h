#pragma once

#include <span>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// The loops round all faces of a planar drawing, each with its face on the left: inner faces run counter-clockwise,
/// the outer border of a part clockwise. Every element is in two loops, once in each direction. After its corners, a
/// loop may have thick ends (scene/thick_ends.h). L loops.
struct FaceLoops {
  std::vector<int> offset;        ///< L + 1, into particles and elements
  std::vector<int> particle;      ///< corners of the loops, one loop after another
  std::vector<int> element;       ///< the element from each corner to the next
  std::vector<int> corner_count;  ///< L
  std::vector<double> area;       ///< L, mm^2; negative for outer borders, 0 round a tree

  [[nodiscard]] std::size_t count() const { return area.size(); }
  /// Of the loop and of its thick ends, if they have been appended.
  [[nodiscard]] std::span<const int> particles_of(std::size_t loop) const {
    return std::span(particle).subspan(offset[loop], offset[loop + 1] - offset[loop]);
  }
  [[nodiscard]] int end_of_corners(std::size_t loop) const { return offset[loop] + corner_count[loop]; }
};

/// Walks along half-edges. At a particle the walk turns clockwise into the next element, so that the face stays on its
/// left. REQUIRES: elements of nonzero length.
FaceLoops trace_loops(std::span<const Vector2> position, std::span<const Element> elements);

/// Area within a loop of particles, mm^2; negative where it runs clockwise.
double area_within(std::span<const int> loop, std::span<const Vector2> position);

}  // namespace cellcrush
