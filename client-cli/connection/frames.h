#pragma once

#include "cellcrush/v1/jobs_service.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// A frame in one piece, with the mesh it belongs to.
struct MeshFrame {
  v1::FieldFrame frame;
  v1::Mesh mesh;
};

/// Fetches the frame that `request` names and joins its parts. Throws CommandError, also when what came does not fit
/// together (cut_off).
MeshFrame fetch_frame(Connection& connection, const v1::GetFrameRequest& request);

}  // namespace cellcrush::client
