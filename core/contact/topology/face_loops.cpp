#include "contact/topology/face_loops.h"

#include <algorithm>
#include <cmath>

namespace cellcrush {
namespace {

/// Half-edge 2 e runs from the start of element e to its end; half-edge 2 e + 1 runs back.
int opposite(int half_edge) { return half_edge ^ 1; }

int origin_of(std::span<const Element> elements, int half_edge) {
  const Element& element = elements[static_cast<std::size_t>(half_edge / 2)];
  return half_edge % 2 == 0 ? element.start : element.end;
}

/// For each half-edge, the one that follows it round the face on its left.
std::vector<int> find_followers(std::span<const Vector2> position, std::span<const Element> elements) {
  const int count = 2 * static_cast<int>(elements.size());
  std::vector<std::vector<int>> leaving(position.size());
  std::vector<double> angle(static_cast<std::size_t>(count));
  for (int half_edge = 0; half_edge < count; ++half_edge) {
    const int origin = origin_of(elements, half_edge);
    const Vector2 along = position[origin_of(elements, opposite(half_edge))] - position[origin];
    angle[half_edge] = std::atan2(along.y(), along.x());
    leaving[origin].push_back(half_edge);
  }
  std::vector<int> follower(static_cast<std::size_t>(count));
  for (std::vector<int>& fan : leaving) {
    std::sort(fan.begin(), fan.end(), [&](int a, int b) { return angle[a] < angle[b]; });
    for (std::size_t i = 0; i < fan.size(); ++i) {
      follower[opposite(fan[i])] = fan[(i + fan.size() - 1) % fan.size()];
    }
  }
  return follower;
}

}  // namespace

std::vector<FaceLoop> trace_loops(std::span<const Vector2> position, std::span<const Element> elements) {
  const std::vector<int> follower = find_followers(position, elements);
  std::vector<bool> walked(follower.size(), false);
  std::vector<FaceLoop> loops;
  for (int first = 0; first < static_cast<int>(follower.size()); ++first) {
    if (walked[first]) {
      continue;
    }
    FaceLoop& loop = loops.emplace_back();
    for (int half_edge = first; !walked[half_edge]; half_edge = follower[half_edge]) {
      walked[half_edge] = true;
      loop.particle.push_back(origin_of(elements, half_edge));
      loop.element.push_back(half_edge / 2);
    }
    loop.corners = loop.particle.size();
    loop.area = area_within(loop.particle, position);
  }
  return loops;
}

void append_thick_ends(const Scene& scene, FaceLoop& loop) {
  for (std::size_t k = 0; k < loop.corners; ++k) {
    const int corner = loop.particle[k];
    const double before = scene.elements[loop.element[(k > 0 ? k : loop.corners) - 1]].thickness;
    const double thickness = std::max(before, scene.elements[loop.element[k]].thickness);
    for (int i = scene.incidence_offset[corner]; i < scene.incidence_offset[corner + 1]; ++i) {
      const Element& element = scene.elements[scene.incidence[i]];
      // An element that stands out at both of its ends is appended once.
      const auto first_end = loop.element.begin() + static_cast<std::ptrdiff_t>(loop.corners);
      if (element.thickness > thickness &&
          std::find(first_end, loop.element.end(), scene.incidence[i]) == loop.element.end()) {
        loop.particle.push_back(element.start == corner ? element.end : element.start);
        loop.element.push_back(scene.incidence[i]);
      }
    }
  }
}

double area_within(std::span<const int> loop, std::span<const Vector2> position) {
  double twice = 0.0;
  // Relative to a corner of the face, so that the area of a small face far from the origin keeps its precision.
  const Vector2& base = position[loop.front()];
  for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
    twice += cross(position[loop[i]] - base, position[loop[i + 1]] - base);
  }
  return 0.5 * twice;
}

}  // namespace cellcrush
