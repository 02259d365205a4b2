#pragma once

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

// Gravity, rigid walls and the end time have a place in `loading`. A frame may have them at a place of its own instead,
// lattice.frame, where they stood first. The solver knows them as those of `loading`.

/// Moves them into the loading; what is given at both places is a problem.
void move_to_loading(v1::Case& scene, Problems& problems);

/// Moves them to the place of the frame, if the lattice is one.
void move_to_frame(v1::Case& scene);

/// Names what a frame lacks, or has at its place, by the paths of the frame.
void name_as_given(const v1::Case& submitted, Problems& problems);

/// The loading with what stands at the place of the frame.
v1::Loading loading_of(const v1::Case& scene);

/// The rigid walls of a case, wherever they stand.
const google::protobuf::RepeatedPtrField<v1::Frame::RigidWall>& rigid_walls_of(const v1::Case& scene);

/// Gives the rigid walls and grips of a completed case the ids that they have in the submitted one.
void restore_ids(const v1::Case& submitted, v1::Case& completed);

}  // namespace cellcrush::translate
