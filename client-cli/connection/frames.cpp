#include "connection/frames.h"

#include <algorithm>

namespace cellcrush::client {

namespace {

bool fits_together(const MeshFrame& whole) {
  const v1::Mesh& mesh = whole.mesh;
  const int elements = mesh.thickness_mm_size();
  const int particles = whole.frame.position_mm_size() / 2;
  const auto known = [&](int node) { return node >= 0 && node < particles; };
  return particles > 0 && mesh.element_nodes_size() == 2 * elements &&
         whole.frame.plastic_fraction_size() == elements &&
         std::all_of(mesh.element_nodes().begin(), mesh.element_nodes().end(), known);
}

}  // namespace

MeshFrame fetch_frame(Connection& connection, const v1::GetFrameRequest& request) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + Connection::kPatience);
  const auto reader = connection.jobs().GetFrame(&context, request);
  MeshFrame whole;
  v1::GetFrameResponse part;
  while (reader->Read(&part)) {
    // Repeated fields are appended by MergeFrom, as the parts of a mesh and of a frame are.
    whole.mesh.MergeFrom(part.mesh().mesh());
    whole.frame.MergeFrom(part.chunk().frame());
  }
  const grpc::Status status = reader->Finish();
  if (!status.ok()) throw error_of(status);
  if (!fits_together(whole)) {
    throw CommandError(ExitCode::cut_off, "received an incomplete frame of " + request.name() +
                                              ": its mesh, positions and plastic fractions do not match");
  }
  return whole;
}

}  // namespace cellcrush::client
