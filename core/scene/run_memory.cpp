#include "scene/run_memory.h"

#include "cellcrush/scene.h"

namespace cellcrush {

std::int64_t memory_of_run(const RunSize& size) {
  constexpr std::size_t kCandidatesPerParticle = 6;
  constexpr std::size_t kBytesPerCandidate = 2 * sizeof(int) + 2 * sizeof(double);
  // What is remembered of it in two steps, how it stands, and what pushes.
  constexpr std::size_t kBytesPerTouch = 2 * (5 * sizeof(int) + sizeof(double)) + 4 * sizeof(int) + 5 * sizeof(double) +
                                         2 * sizeof(Vector2) + 4 * sizeof(double);
  const std::size_t per_particle = 9 * sizeof(Vector2) + 9 * sizeof(double) + 2 * sizeof(int) +
                                   kCandidatesPerParticle * kBytesPerCandidate + kBytesPerTouch;
  const std::size_t remembered =
      (size.hardening ? 3 : 1) * size.fibres + (size.force_based ? 2 * size.sections + 2 : 0);
  const std::size_t per_element = sizeof(Element) + 2 * sizeof(int) + sizeof(Vector2) + sizeof(double) +
                                  3 * (sizeof(Vector2) + sizeof(double)) / 2 + sizeof(std::uint64_t) +
                                  remembered * sizeof(double);
  const std::size_t per_corner = 2 * sizeof(int) + sizeof(Vector2);
  return static_cast<std::int64_t>(size.particles * per_particle + size.elements * per_element +
                                   size.face_corners * per_corner);
}

}  // namespace cellcrush
