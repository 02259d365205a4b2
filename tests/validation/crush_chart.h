#pragma once

#include <string>
#include <vector>

#include "cellcrush/sample.h"
#include "chart/chart.h"

namespace cellcrush::validation {

/// A curve and what it is called.
struct NamedCurve {
  std::string name;
  std::vector<Sample> samples;  ///< not empty
};

/// The impact plate's stress, smoothed over 0.01 of strain, with salient peaks as discs and the onset of densification
/// as a square. `along` is &Sample::strain or &Sample::travel.
client::Chart crush_chart(const std::vector<NamedCurve>& curves, double Sample::*along);

}  // namespace cellcrush::validation
