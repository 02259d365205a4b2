#pragma once

#include "cellcrush/v1/jobs_service.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// A complete frame, with its mesh.
struct MeshFrame {
  v1::FieldFrame frame;
  v1::Mesh mesh;
};

/// Fetches the requested frame and joins its parts. Throws CommandError, also if the parts are inconsistent (cut_off).
MeshFrame fetch_frame(Connection& connection, const v1::GetFrameRequest& request);

}  // namespace cellcrush::client
