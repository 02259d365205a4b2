#pragma once

#include "chart/chart.h"
#include "chart/job_curves.h"

namespace cellcrush::client {

/// The ledger of a crush against strain, in J: the work of the plates and, each as a line of its own, where it has
/// gone. What stays 0 is left out, but not the residual.
Chart build_energy_chart(const JobHistory& history);

}  // namespace cellcrush::client
