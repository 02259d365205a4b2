#pragma once

#include "cellcrush/v1/sweep.pb.h"
#include "chart/chart.h"

namespace cellcrush::client {

/// Plateau stress at both plates against the first varied field, with Eq. 51, Eq. 52 and Gibson-Ashby beside it; when speed alone
/// is varied also the quadratic fit. Several varied fields give a series a combination of the others. Throws CommandError
/// (refused) when no job has a plateau yet, or nothing is varied.
Chart build_sweep_chart(const v1::SweepTable& table);

/// A field's name for an axis: "loading.speed_m_per_s" becomes "speed (m/s)".
std::string axis_label(const std::string& field);

}  // namespace cellcrush::client
