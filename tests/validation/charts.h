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

/// A crush's plateau beside its theories, of a row of a table that validate wrote.
struct Plateau {
  std::string preset;
  double speed = 0.0;    ///< m/s
  double impact = 0.0;   ///< MPa, as the others
  double support = 0.0;  ///< MPa
  double shock = 0.0;    ///< MPa, Eq. 51
  double front = 0.0;    ///< MPa, Eq. 52; not a number without a front
};

/// Of the crushes of a preset with so many elements per wall, by speed. What they may differ in besides is the
/// imperfection and what is output: several at one speed are seeds. Throws std::invalid_argument on a table that is
/// none, or without such a row.
std::vector<Plateau> read_plateaus(const std::vector<std::string>& tables, const std::string& preset, int elements);

/// The plateaus of a preset at both plates against the speed, with Eq. 51 and 52.
client::Chart theory_chart(const std::vector<Plateau>& plateaus);

/// The impact plateaus of several presets against the speed, up to a speed, with quadratic fits through all of them. A
/// preset's legend tells the fit, or nothing without one.
client::Chart fit_chart(const std::vector<std::vector<Plateau>>& presets, double to_speed);

}  // namespace cellcrush::validation
