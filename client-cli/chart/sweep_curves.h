#pragma once

#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "chart/chart.h"

namespace cellcrush::client {

/// A sweep with its results.
struct SweepResults {
  v1::Sweep sweep;
  v1::SweepTable table;
};

struct LogarithmicAxes {
  bool x = false;
  bool y = false;
};

/// Plateau stress against the first varied field. Of one sweep at both plates, with theory beside it; when speed alone
/// is varied also with the quadratic fit; several varied fields give a series a combination of the others. Of several
/// sweeps at the impact plate, a colour and a mark each, named by title or by what their cases differ in. Throws
/// CommandError (refused) when no job has a plateau yet, nothing or different fields are varied, or an axis cannot be
/// logarithmic.
Chart build_sweep_chart(const std::vector<SweepResults>& sweeps, const LogarithmicAxes& logarithmic = {});

/// A field's name for an axis: "loading.speed_m_per_s" becomes "speed (m/s)".
std::string axis_label(const std::string& field);

}  // namespace cellcrush::client
