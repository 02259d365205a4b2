#pragma once

#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "chart/chart.h"

namespace cellcrush::client {

/// Why a sweep cannot be drawn yet.
inline constexpr const char* kNoPlateauYet =
    "no job of the sweep has succeeded with a plateau yet; `cellcrush table` shows the state of its jobs";

/// A sweep with its results, a charted_table().
struct SweepResults {
  v1::Sweep sweep;
  v1::SweepTable table;
};

struct LogarithmicAxes {
  bool x = false;
  bool y = false;
};

/// Plateau stress against the first varied field. For one sweep: both plates with theory, the quadratic fit if only
/// speed varies, and one series for each combination of the other varied fields. For several sweeps: the impact plate,
/// one colour and mark per curve, named by title and the differences of their cases. Means have bars of their 95 %
/// intervals; letters mark densification within the plateau window and warnings. Throws CommandError (refused) if
/// no job has a plateau yet, if nothing or different fields are varied, or if an axis cannot be logarithmic.
Chart build_sweep_chart(const std::vector<SweepResults>& sweeps, const LogarithmicAxes& logarithmic = {});

/// A field's label for an axis: "loading.speed_m_per_s" becomes "speed (m/s)".
std::string axis_label(const std::string& field);

}  // namespace cellcrush::client
