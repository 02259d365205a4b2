#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/tuning.h"

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

/// Pieces in which a sample looks at some blocks or chunks, for any threads.
inline std::size_t sampled_pieces(std::size_t items) { return (items + kSampledTogether - 1) / kSampledTogether; }

template <class Item>
std::span<const Item> sampled_piece(const std::vector<Item>& items, std::size_t piece) {
  const std::size_t first = piece * kSampledTogether;
  return std::span(items).subspan(first, std::min(kSampledTogether, items.size() - first));
}

/// Calls visit(block, first element) for every row of some blocks of walls, ascending.
template <class Visit>
void visit_rows(std::span<const WallBlock> blocks, Visit&& visit) {
  for (const WallBlock& block : blocks) {
    for (int j = 0; j < block.elements; ++j) {
      const std::size_t row = block.first_element + j * block.walls;
      visit(block, row);
    }
  }
}

/// Calls visit(place, wall) for every element, ascending.
template <class Visit>
void visit_elements(const Scene& scene, Visit&& visit) {
  visit_rows(scene.walls.blocks, [&](const WallBlock& block, std::size_t row) {
    for (int w = 0; w < block.walls; ++w) {
      visit(ElementPlace{row + w, row, static_cast<std::size_t>(block.walls)}, block.first_wall + w);
    }
  });
}

}  // namespace cellcrush
