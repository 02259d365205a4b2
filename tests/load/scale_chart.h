#pragma once

#include <string>
#include <vector>

namespace cellcrush::load {

/// Slots that one daemon keeps busy, by the length of the jobs.
struct LimitCurve {
  std::string name;
  std::vector<double> run_s;
  std::vector<double> slots;
};

/// Draws the curves, at least one of which has a point, into a file .svg or .png. Throws std::invalid_argument on
/// another name, std::runtime_error when it cannot be written.
void draw_limits(const std::string& file, const std::vector<LimitCurve>& curves);

}  // namespace cellcrush::load
