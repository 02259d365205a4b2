#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Overwrites ContactWorkspace::overlapping by the places of the candidates whose capsules overlap now, ascending.
///
/// Where contacts are searched by faces, a batch of candidates of which none overlaps sleeps until its least gap can have
/// closed: until its group has travelled that far (contact/face_search.h). Lists are made by ascending gaps, so that those
/// that touch are together. The batches that do not touch are seven in eight, and tested in one step of ten.
void find_overlaps(const Scene& scene, State& state, ContactWorkspace& workspace);

}  // namespace cellcrush
