#include "scene/thick_ends.h"

#include <algorithm>
#include <utility>

namespace cellcrush {
namespace {

bool is_uniform(const Scene& scene) {
  return std::all_of(scene.elements.begin(), scene.elements.end(),
                     [&](const Element& element) { return element.thickness == scene.elements.front().thickness; });
}

/// Appends the thick ends at a corner between two walls of the loop that is being filled; an element that stands out at
/// both of its ends once.
void append_ends_at(const Scene& scene, int corner, double thickness, std::ptrdiff_t first, FaceLoops& loops) {
  for (int k = scene.incidence_offset[corner]; k < scene.incidence_offset[corner + 1]; ++k) {
    const int e = scene.incidence[k];
    const Element& element = scene.elements[e];
    if (element.thickness > thickness &&
        std::find(loops.element.begin() + first, loops.element.end(), e) == loops.element.end()) {
      loops.particle.push_back(element.start == corner ? element.end : element.start);
      loops.element.push_back(e);
    }
  }
}

}  // namespace

void append_thick_ends(const Scene& scene, FaceLoops& loops) {
  if (is_uniform(scene)) {
    return;
  }
  FaceLoops traced = std::exchange(loops, {});
  loops.area = std::move(traced.area);
  loops.corner_count = std::move(traced.corner_count);
  loops.offset.push_back(0);
  for (std::size_t loop = 0; loop < loops.count(); ++loop) {
    const int first = traced.offset[loop];
    const int end = traced.offset[loop + 1];
    loops.particle.insert(loops.particle.end(), traced.particle.begin() + first, traced.particle.begin() + end);
    loops.element.insert(loops.element.end(), traced.element.begin() + first, traced.element.begin() + end);
    const auto first_end = static_cast<std::ptrdiff_t>(loops.element.size());
    for (int k = first; k < end; ++k) {
      const int before = traced.element[k > first ? k - 1 : end - 1];
      const double thickness = std::max(scene.elements[before].thickness, scene.elements[traced.element[k]].thickness);
      append_ends_at(scene, traced.particle[k], thickness, first_end, loops);
    }
    loops.offset.push_back(static_cast<int>(loops.particle.size()));
  }
}

}  // namespace cellcrush
