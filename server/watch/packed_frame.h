#pragma once

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::watch {

/// The frame with its numbers packed (FieldFrame.Packed). `mesh` has the positions before loading; without them the
/// displacements are the positions.
v1::FieldFrame pack(const v1::FieldFrame& frame, const v1::Mesh* mesh);

}  // namespace cellcrush::watch
