#pragma once

#include "chart/chart.h"
#include "chart/job_curves.h"

namespace cellcrush::client {

/// An explicit frame over time: displacements of its watched nodes, or their rotations if none moved; energies if it
/// watches no nodes.
Chart build_node_chart(const JobHistory& history);

}  // namespace cellcrush::client
