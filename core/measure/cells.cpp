#include "measure/cells.h"

#include <algorithm>

#include "contact/topology/face_loops.h"

namespace cellcrush {
namespace {

Vector2 mean_of(std::span<const int> loop, std::span<const Vector2> position) {
  Vector2 sum = Vector2::Zero();
  for (const int particle : loop) {
    sum += position[particle];
  }
  return sum / static_cast<double>(loop.size());
}

}  // namespace

Faces trace_faces(std::span<const Vector2> position, std::span<const Element> elements) {
  Faces faces;
  faces.offset.push_back(0);
  for (const FaceLoop& loop : trace_loops(position, elements)) {
    if (loop.area > 0.0) {
      faces.particles.insert(faces.particles.end(), loop.particle.begin(), loop.particle.end());
      faces.offset.push_back(static_cast<int>(faces.particles.size()));
      faces.area.push_back(loop.area);
      faces.centre.push_back(mean_of(loop.particle, position));
    }
  }
  return faces;
}

std::vector<double> area_ratios(const Faces& faces, std::span<const Vector2> position) {
  std::vector<double> ratios;
  ratios.reserve(faces.count());
  for (std::size_t face = 0; face < faces.count(); ++face) {
    ratios.push_back(area_within(faces.particles_of(face), position) / faces.area[face]);
  }
  return ratios;
}

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
  const auto along = [&](int particle) { return scene.position[particle][axis]; };
  double extents = 0.0;
  for (std::size_t face = 0; face < cells.faces.count(); ++face) {
    const auto [begin, end] = std::ranges::minmax_element(cells.faces.particles_of(face), {}, along);
    extents += along(*end) - along(*begin);
    const Vector2 centre = cells.faces.centre[face] - low;
    cells.field.along.push_back(centre[axis]);
    cells.field.across.push_back(centre[1 - axis]);
  }
  cells.field.collapsed.assign(cells.faces.count(), false);
  cells.field.length = (high - low)[axis];
  cells.field.width = (high - low)[1 - axis];
  cells.field.pitch = cells.faces.count() > 0 ? extents / static_cast<double>(cells.faces.count()) : 0.0;
  return cells;
}

CollapseField find_collapse(const Cells& cells, std::span<const Vector2> position) {
  CollapseField field = cells.field;
  const std::vector<double> ratio = area_ratios(cells.faces, position);
  std::transform(ratio.begin(), ratio.end(), field.collapsed.begin(), [](double of) { return of <= kCollapsedArea; });
  return field;
}

}  // namespace cellcrush
