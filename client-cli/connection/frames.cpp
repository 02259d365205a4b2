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

// Ends that have broken off become particles of their own.
bool part_broken_ends(MeshFrame& whole) {
  v1::FieldFrame& frame = whole.frame;
  v1::Mesh& mesh = whole.mesh;
  if (2 * frame.broken_end_size() != frame.end_position_mm_size()) return false;
  for (int k = 0; k < frame.broken_end_size(); ++k) {
    const int end = frame.broken_end(k);
    if (end < 0 || end >= mesh.element_nodes_size()) return false;
    const int node = mesh.element_nodes(end);
    mesh.set_element_nodes(end, frame.position_mm_size() / 2);
    for (const int axis : {0, 1}) {
      frame.add_position_mm(frame.end_position_mm(2 * k + axis));
      if (2 * node + axis < mesh.position_mm_size()) mesh.add_position_mm(mesh.position_mm(2 * node + axis));
    }
  }
  return true;
}

// The frame nearest to a share of the run: by strain, or by time for a frame without plates.
MeshFrame fetch_frame_of_share(Connection& connection, const std::string& name, const MeshFrame& last, double share) {
  return fetch_frame(connection, name, [&](v1::GetFrameRequest& which) {
    last.has_plates() ? which.set_strain(share * last.frame.strain()) : which.set_time_s(share * last.frame.time_s());
  });
}

}  // namespace

MeshFrame fetch_frame(Connection& connection, const std::string& name,
                      const std::function<void(v1::GetFrameRequest& request)>& choose) {
  v1::GetFrameRequest request;
  request.set_name(name);
  choose(request);
  MeshFrame whole;
  const grpc::Status status = connection.read(connection.jobs(), &v1::Jobs::Stub::GetFrame, request,
                                              Connection::kPatience, [&](const v1::GetFrameResponse& part) {
                                                // MergeFrom appends repeated fields, the parts of a mesh and a frame.
                                                whole.mesh.MergeFrom(part.mesh().mesh());
                                                whole.frame.MergeFrom(part.chunk().frame());
                                                return true;
                                              });
  if (!status.ok()) throw error_of(status);
  if (!fits_together(whole) || !part_broken_ends(whole)) {
    throw CommandError(ExitCode::cut_off, "received an incomplete frame of " + name +
                                              ": its mesh, positions and plastic fractions do not match");
  }
  return whole;
}

MeshFrame fetch_frame(Connection& connection, const std::string& name, int index) {
  return fetch_frame(connection, name, [index](v1::GetFrameRequest& request) { request.set_index(index); });
}

std::vector<MeshFrame> fetch_strip(Connection& connection, const std::string& name, int count) {
  const MeshFrame last = fetch_frame(connection, name, -1);
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
  const MeshFrame last = fetch_frame(connection, name, -1);
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
  for (const double strain : strains) {
    stages.push_back(
        fetch_frame(connection, name, [strain](v1::GetFrameRequest& request) { request.set_strain(strain); }));
  }
  return stages;
}

}  // namespace cellcrush::client
