#pragma once

#include "chart/chart.h"
#include "chart/job_curves.h"

namespace cellcrush::client {

/// The energy ledger of a crush against strain, in J: the work of the plates, and one line for each way it was used.
/// Terms that stay 0 are omitted, except the residual.
Chart build_energy_chart(const JobHistory& history);

}  // namespace cellcrush::client
