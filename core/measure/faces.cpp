#include "measure/faces.h"

#include "scene/face_loops.h"

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
  const FaceLoops loops = trace_loops(position, elements);
  Faces faces;
  faces.offset.push_back(0);
  for (std::size_t i = 0; i < loops.count(); ++i) {
    if (loops.area[i] > 0.0) {
      const std::span<const int> loop = loops.particles_of(i);
      faces.particles.insert(faces.particles.end(), loop.begin(), loop.end());
      faces.offset.push_back(static_cast<int>(faces.particles.size()));
      faces.area.push_back(loops.area[i]);
      faces.centre.push_back(mean_of(loop, position));
    }
  }
  return faces;
}

std::vector<double> area_ratios(const Faces& faces, std::span<const Vector2> position) {
  std::vector<double> ratios;
  ratios.reserve(faces.count());
  for (std::size_t face = 0; face < faces.count(); ++face) {
    const std::size_t begin = faces.offset[face];
    const std::span<const int> loop(&faces.particles[begin], faces.offset[face + 1] - begin);
    ratios.push_back(area_within(loop, position) / faces.area[face]);
  }
  return ratios;
}

}  // namespace cellcrush
