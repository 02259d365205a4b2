#include "connection/frames.h"

#include <algorithm>
#include <utility>

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

MeshFrame fetch_frame_at(Connection& connection, const std::string& name, double strain) {
  v1::GetFrameRequest request;
  request.set_name(name);
  request.set_strain(strain);
  return fetch_frame(connection, request);
}

MeshFrame fetch_last_frame(Connection& connection, const std::string& name) {
  v1::GetFrameRequest request;
  request.set_name(name);
  request.set_index(-1);
  return fetch_frame(connection, request);
}

// The frame nearest to a share of the run: by strain, or by time for a frame without plates.
MeshFrame fetch_frame_of_share(Connection& connection, const std::string& name, const MeshFrame& last, double share) {
  if (last.has_plates()) return fetch_frame_at(connection, name, share * last.frame.strain());
  v1::GetFrameRequest request;
  request.set_name(name);
  request.set_time_s(share * last.frame.time_s());
  return fetch_frame(connection, request);
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

std::vector<MeshFrame> fetch_strip(Connection& connection, const std::string& name, int count) {
  const MeshFrame last = fetch_last_frame(connection, name);
  std::vector<MeshFrame> stages;
  for (int i = 0; i + 1 < count; ++i) {
    MeshFrame stage = fetch_frame_of_share(connection, name, last, static_cast<double>(i) / (count - 1));
    const bool known = !stages.empty() && stages.back().frame.index() == stage.frame.index();
    if (!known && stage.frame.index() != last.frame.index()) stages.push_back(std::move(stage));
  }
  stages.push_back(last);
  return stages;
}

std::vector<MeshFrame> fetch_default_stages(Connection& connection, const std::string& name) {
  constexpr double kApart = 0.05;
  const MeshFrame last = fetch_last_frame(connection, name);
  const double end = last.has_plates() ? last.frame.strain() : 0.6;
  std::vector<MeshFrame> stages;
  for (const double strain : {0.2, 0.4}) {
    if (strain >= end - kApart) continue;
    MeshFrame stage = fetch_frame_of_share(connection, name, last, strain / end);
    // A running job may have fewer frames available.
    if (stage.frame.index() != last.frame.index()) stages.push_back(std::move(stage));
  }
  stages.push_back(last);
  return stages;
}

std::vector<MeshFrame> fetch_stages_at(Connection& connection, const std::string& name,
                                       const std::vector<double>& strains) {
  std::vector<MeshFrame> stages;
  stages.reserve(strains.size());
  for (const double strain : strains) stages.push_back(fetch_frame_at(connection, name, strain));
  return stages;
}

}  // namespace cellcrush::client
