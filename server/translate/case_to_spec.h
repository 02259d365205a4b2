#pragma once

#include <optional>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

/// A case as the solver's spec, and problems of the conversion. The spec can be checked for further problems even so:
/// fields that could not be converted have their defaults.
struct CaseReading {
  SceneSpec spec;
  Problems problems;
};

/// Purely mechanical: an absent field takes the spec's default or stays missing, and no physics is checked. Problems
/// are those of the wire format only: unknown enum numbers, an over-long title, unknown node names, and fields without
/// a counterpart in the spec.
CaseReading to_spec(const v1::Case& in);

/// The lattice of equal cells of a case; nothing for a frame, or without a lattice.
std::optional<RegularLattice> read_regular(const v1::Lattice& in);

/// Converts the walls of a frame, and the loads on its nodes and beams; appends problems.
FrameWalls to_spec(const v1::Frame& in, LoadsSpec& loads, Problems& problems);

/// Those of a loading; appends problems.
std::vector<LoadsSpec::RigidWall> read_rigid_walls(const v1::Loading& in, Problems& problems);

// Reads lines and displacements of grips, without what an enum says.
std::vector<LoadsSpec::Grip> read_gripped_edges(const v1::Loading& in, Problems& problems);

/// A material; the paths of its fields start with `path`.
MaterialSpec to_spec(const v1::Material& in, const std::string& path, Problems& problems);

}  // namespace cellcrush::translate
