#pragma once

#include <string>
#include <vector>

#include "connection/frames.h"

namespace cellcrush::client {

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
