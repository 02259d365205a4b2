#pragma once

#include <string>
#include <vector>

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

// Gravity, rigid walls and the end time have a place in `loading`. A frame may have them at a place of its own instead,
// lattice.frame, where they stood first. The solver knows them as those of `loading`.

using RigidWalls = google::protobuf::RepeatedPtrField<v1::Frame::RigidWall>;

/// Those of a case, wherever they stand.
const RigidWalls& rigid_walls_of(const v1::Case& scene);

/// Reads what has two places into the spec; what is given at both is a problem.
void read_loads(const v1::Case& in, SceneSpec& spec, Problems& problems);

/// Writes it to the place of a frame, if the lattice is one, or into the loading.
void write_loads(const SceneSpec& spec, v1::Case& out);

/// Names what a frame lacks, or has at its place, by the paths of the frame.
void name_as_given(const v1::Case& submitted, Problems& problems);

/// Converts rigid walls at a path; appends problems.
std::vector<LoadsSpec::RigidWall> read_rigid_walls(const RigidWalls& in, const std::string& path, Problems& problems);

}  // namespace cellcrush::translate
