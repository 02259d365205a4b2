#include "measure/collapse.h"

#include <algorithm>
#include <limits>

namespace cellcrush {

Cells find_cells(const Scene& scene) {
  Cells cells;
  cells.faces = trace_faces(scene.position, scene.elements);
  const int axis = scene.plates.axis;
  Vector2 low = scene.position.front();
  Vector2 high = low;
  for (const Vector2& position : scene.position) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  double extents = 0.0;
  for (std::size_t face = 0; face < cells.faces.count(); ++face) {
    double begin = std::numeric_limits<double>::max();
    double end = std::numeric_limits<double>::lowest();
    for (int i = cells.faces.offset[face]; i < cells.faces.offset[face + 1]; ++i) {
      const double place = scene.position[cells.faces.particles[i]][axis];
      begin = std::min(begin, place);
      end = std::max(end, place);
    }
    extents += end - begin;
    const Vector2 centre = cells.faces.centre[face] - low;
    cells.field.along.push_back(centre[axis]);
    cells.field.across.push_back(centre[1 - axis]);
  }
  cells.field.collapsed.assign(cells.faces.count(), false);
  cells.field.length = (high - low)[axis];
  cells.field.width = (high - low)[1 - axis];
  cells.field.pitch = extents / static_cast<double>(cells.faces.count());
  return cells;
}

CollapseField find_collapse(const Cells& cells, std::span<const Vector2> position) {
  CollapseField field = cells.field;
  const std::vector<double> ratio = area_ratios(cells.faces, position);
  for (std::size_t cell = 0; cell < ratio.size(); ++cell) {
    field.collapsed[cell] = ratio[cell] <= kCollapsedArea;
  }
  return field;
}

std::vector<Vector2> positions_of(const FieldFrame& frame) {
  std::vector<Vector2> position;
  for (std::size_t i = 0; i + 1 < frame.position.size(); i += 2) {
    position.emplace_back(frame.position[i], frame.position[i + 1]);
  }
  return position;
}

}  // namespace cellcrush
