#pragma once

#include <string>
#include <vector>

#include "bench/precision.h"

namespace cellcrush::bench {

/// The four series of a chart. Variants other than the three kinds of element change one setting of two force-based
/// elements.
enum class Family { force_based, displacement_based, papers, other_setting };

inline constexpr int kFamilyCount = 4;

Family family_of(const std::string& variant);
std::string name_of(Family family);

/// What stands beside a variant's mark: elements a wall, or the setting that it changes, in words.
std::string label_of(const std::string& variant);

/// A mark of a chart, in seconds and per cent.
struct PrecisionPoint {
  double seconds = 0.0;
  double error = 0.0;  ///< what is claimed
  double low = 0.0;    ///< of the 95 % interval; 0 where that holds no error at all
  double high = 0.0;
  bool is_bound = false;  ///< the error lies inside its own interval, half of which is drawn
  bool on_front = false;
  std::string label;
};

struct PrecisionSeries {
  Family family = Family::force_based;
  std::vector<PrecisionPoint> points;  ///< by time
};

/// The families that have points, in their order. `absolute` measures are not bounds: their own value is the error.
std::vector<PrecisionSeries> series_of(const std::vector<Precision>& all, const Measure& measure,
                                       const std::string& converged);

}  // namespace cellcrush::bench
