#pragma once

#include <memory>
#include <optional>

#include "cellcrush/scene_spec.h"
#include "scene/lattice_lengths.h"
#include "scene/lattices.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// Measures meshes of regular lattices without building them: to the last bit what measure_mesh says of the mesh. Remembers the
/// last pattern and its lengths, so that thickness, depth and material cost next to nothing, and a size or a seed only the
/// places of the joints. Not thread-safe.
class LatticeMeasurer {
 public:
  LatticeMeasurer();
  ~LatticeMeasurer();
  LatticeMeasurer(const LatticeMeasurer&) = delete;
  LatticeMeasurer& operator=(const LatticeMeasurer&) = delete;

  /// None of a frame, and where it takes the mesh to tell whether walls lie in each other (scene/lattice_overlap.h).
  /// REQUIRES: a mesh part in which nothing spoils the mesh.
  std::optional<MeshMeasures> measure(const SceneSpec& part);

 private:
  struct KnownPattern;
  struct KnownLengths;
  const KnownPattern& pattern_of(const RegularLattice& lattice);
  const LatticeLengths& lengths_of(const RegularLattice& lattice, const Imperfection& imperfection);

  std::unique_ptr<KnownPattern> pattern_;
  std::unique_ptr<KnownLengths> lengths_;  ///< of that pattern; null when none are known
};

}  // namespace cellcrush
