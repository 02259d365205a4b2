#pragma once

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::watch {

/// The frame with its numbers packed (FieldFrame.Packed). `mesh` is the one that receivers have; null: they have none.
/// Without positions in it the displacements are the positions.
v1::FieldFrame pack(const v1::FieldFrame& frame, const v1::Mesh* mesh);

}  // namespace cellcrush::watch
