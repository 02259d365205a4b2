#pragma once

#include <cstddef>
#include <cstdint>

namespace cellcrush {

/// What the memory of a run depends on.
struct RunSize {
  std::size_t particles = 0;
  std::size_t elements = 0;
  std::size_t face_corners = 0;  ///< of the faces by which contacts are searched, two an element; 0 by buckets
  std::size_t sections = 0;      ///< of an element
  std::size_t fibres = 0;        ///< of an element
  bool force_based = false;
  bool hardening = false;  ///< of any material
};

/// Bytes of a run: the state's and the scene's arrays. Contact candidates are counted at six a particle, pairs that
/// touch at one a particle: what a densified lattice has.
std::int64_t memory_of_run(const RunSize& size);

}  // namespace cellcrush
