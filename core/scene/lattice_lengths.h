#pragma once

#include <array>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "scene/lattice_pattern.h"
#include "scene/lattices.h"

namespace cellcrush {

/// The joints of a pattern of which one may be the lightest particle, and the walls that end there. J joints.
struct JointWalls {
  struct End {
    int wall = 0;  ///< into LatticePattern::walls
    bool at_end = false;
  };
  std::vector<int> offset;  ///< J + 1, into ends
  std::vector<End> ends;    ///< of each joint, in the order in which a mesh adds up its mass
};

/// Lengths of the elements at a particle, in the order in which a mesh adds up its mass.
struct ParticleLengths {
  static constexpr int kMostElements = 6;  ///< that meet in a joint
  int count = 0;
  std::array<int, kMostElements> kind = {};
  std::array<double, kMostElements> length = {};  ///< mm
};

/// What steps and masses take from where the joints of a lattice are, whatever the thickness of its walls, to the last bit.
struct LatticeLengths {
  ByWallKind shortest = {};  ///< undeformed length of walls that are divided, mm; infinite where there is none
  std::vector<ParticleLengths> light;  ///< the lightest particle of the mesh is as heavy as the lightest of these
};

/// Whether walls of a kind are parts of rigid bodies, and not divided.
bool is_rigid(const LatticeSizes& sizes, int kind);

JointWalls find_light_joints(const LatticePattern& pattern, const LatticeSizes& sizes);

/// REQUIRES: `joints` are those of the pattern with as many elements a wall, and as rigid.
LatticeLengths measure_lengths(const LatticePattern& pattern, const JointWalls& joints, const RegularLattice& lattice,
                               const Imperfection& imperfection);

}  // namespace cellcrush
