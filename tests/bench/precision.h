#pragma once

#include <string>
#include <vector>

#include "bench/csv_table.h"
#include "bench/variants.h"

namespace cellcrush::bench {

/// What errors are taken of: a column of the table. `absolute`: the value is itself an error, the converged one's is
/// not asked.
struct Measure {
  std::string column;
  std::string title;
  bool absolute = false;
};
inline const std::vector<Measure> kMeasures = {{"plateau_stress_support", "support plateau", false},
                                               {"plateau_stress_impact", "impact plateau", false},
                                               {"limit_stress", "limit stress", false},
                                               {"energy_error_relative", "energy ledger", true}};

/// The variant from which errors are, unless another is named.
inline const std::string kConverged = "converged:8";

/// A variant's error of one measure, over its seeds.
struct Precision {
  std::string variant;
  double seconds = 0.0;      ///< mean processor time of a crush
  double error = 0.0;        ///< relative, of the mean over the seeds from the converged one's
  double uncertainty = 0.0;  ///< half of the 95 % interval of that, from the scatter of both over their seeds
  double scatter = 0.0;      ///< standard deviation of one of its crushes, relative
  int seeds = 0;
  bool on_front = false;  ///< none is as fast and surer: an error counts no less than its uncertainty
};

/// No error below its uncertainty is claimed.
double claimed_error(const Precision& precision);

/// Of every variant of a scene that has rows of at least two seeds, in the list's order. `converged` names the variant
/// from which the errors are; its own is none, to its uncertainty. `scatter` becomes the relative standard deviation of
/// one of its crushes. Rows of variants whose words have changed since are left out, and so are crushes that did not
/// finish. Throws std::invalid_argument when the converged variant has no rows.
std::vector<Precision> precisions(const VariedScene& scene, const std::vector<CsvRow>& rows, const Measure& measure,
                                  const std::string& converged, double& scatter);

/// Whether a row is the crush of a variant for some seed; words that changed since make it another.
bool is_of(const CsvRow& row, const VariedScene& scene, const Variant& variant);

}  // namespace cellcrush::bench
