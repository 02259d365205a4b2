#pragma once

#include <string>
#include <vector>

#include "connection/frames.h"

namespace cellcrush::client {

// The frames of a job that a picture shows, in the order of the run. All throw CommandError.

/// The frames at 20 % and 40 % strain, if they are clearly before the last one, and the last one; of an explicit frame
/// those at a third and two thirds of its time.
std::vector<MeshFrame> fetch_default_stages(Connection& connection, const std::string& name);

/// `count` frames evenly spaced in strain from the undeformed lattice to the last one (an explicit frame's: in time),
/// or fewer when the run kept fewer; one is the last. REQUIRES: count is above 0.
std::vector<MeshFrame> fetch_strip(Connection& connection, const std::string& name, int count);

/// The frames nearest to these strains.
std::vector<MeshFrame> fetch_stages_at(Connection& connection, const std::string& name,
                                       const std::vector<double>& strains);

}  // namespace cellcrush::client
