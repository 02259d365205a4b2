#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/jobs_service.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// A complete frame, with its mesh. Ends of walls that have broken off are particles of their own, after all others.
struct MeshFrame {
  v1::FieldFrame frame;
  v1::Mesh mesh;

  /// Whether the lattice stands between two plates; an explicit frame does not.
  [[nodiscard]] bool has_plates() const { return mesh.support_plate_mm() > mesh.impact_plate_mm(); }
};

/// Fetches the frame of a job that `choose` asks for, or that of an index (-1: the last), and joins its parts. Throws
/// CommandError, also if the parts are inconsistent (cut_off).
MeshFrame fetch_frame(Connection& connection, const std::string& name,
                      const std::function<void(v1::GetFrameRequest& request)>& choose);
MeshFrame fetch_frame(Connection& connection, const std::string& name, int index);

// The frames of a job that a picture shows, in chronological order. All throw CommandError.

/// The frames at 20 % and 40 % strain, if clearly before the last one, and the last one. For an explicit frame, those
/// at a third and two thirds of its time instead.
std::vector<MeshFrame> fetch_default_stages(Connection& connection, const std::string& name);

/// `count` frames evenly spaced in strain (time for an explicit frame) from the undeformed lattice to the last frame,
/// or fewer if the run kept fewer. REQUIRES: count is above 0.
std::vector<MeshFrame> fetch_strip(Connection& connection, const std::string& name, int count);

/// The frames nearest to these strains.
std::vector<MeshFrame> fetch_stages_at(Connection& connection, const std::string& name,
                                       const std::vector<double>& strains);

}  // namespace cellcrush::client
