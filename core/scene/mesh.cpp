#include "scene/mesh.h"

namespace cellcrush {

Mesh divide_walls(const Layout& layout) {
  Mesh mesh;
  mesh.position = layout.joints;
  for (const Wall& wall : layout.walls) {
    const Vector2 from = layout.joints[wall.start];
    const Vector2 to = layout.joints[wall.end];
    int previous = wall.start;
    for (int i = 1; i <= wall.elements; ++i) {
      int next = wall.end;
      if (i < wall.elements) {
        next = static_cast<int>(mesh.position.size());
        mesh.position.emplace_back(from + (to - from) * (static_cast<double>(i) / wall.elements));
      }
      mesh.elements.push_back({previous, next, wall.thickness, wall.material});
      previous = next;
    }
  }
  return mesh;
}

}  // namespace cellcrush
