#pragma once

#include "chart/chart.h"
#include "chart/job_curves.h"

namespace cellcrush::client {

/// What an explicit frame did over time: the displacements of its watched nodes, or their rotations when none moved;
/// the energies of the frame when it watches none.
Chart build_node_chart(const JobHistory& history);

}  // namespace cellcrush::client
