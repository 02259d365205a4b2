#pragma once

#include <cstddef>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Index of the values of an element in the arrays of the state. The elements with the same number in the walls of a
/// block make a row. The values of a row lie one after another, walls innermost.
struct ElementPlace {
  std::size_t element = 0;
  std::size_t row = 0;     ///< first element of the row
  std::size_t stride = 0;  ///< walls of the block

  /// Index of value i of the element, in an array with `per_element` values for each element.
  [[nodiscard]] std::size_t index(std::size_t per_element, std::size_t i) const {
    return row * per_element + i * stride + (element - row);
  }
};

/// Calls visit(block, first element) for every row, ascending.
template <class Visit>
void visit_rows(const Scene& scene, Visit&& visit) {
  for (const WallBlock& block : scene.walls.blocks) {
    for (int j = 0; j < block.elements; ++j) {
      const std::size_t row = block.first_element + j * block.walls;
      visit(block, row);
    }
  }
}

/// Calls visit(place, wall) for every element, ascending.
template <class Visit>
void visit_elements(const Scene& scene, Visit&& visit) {
  visit_rows(scene, [&](const WallBlock& block, std::size_t row) {
    for (int w = 0; w < block.walls; ++w) {
      visit(ElementPlace{row + w, row, static_cast<std::size_t>(block.walls)}, block.first_wall + w);
    }
  });
}

}  // namespace cellcrush
