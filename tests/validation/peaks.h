#pragma once

#include <span>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush::validation {

/// A salient maximum of a curve.
struct Peak {
  double strain = 0.0;
  double stress = 0.0;  ///< MPa, smoothed
  double prominence =
      0.0;  ///< MPa by which the curve must be left before it rises higher, to that side where it is less
};

// Peaks are counted on the mean of the stress over kPeakSmoothing of strain, from the first full window to a last
// strain, and are salient whose prominence, as of mountains, is kSalient of the plateau or more. What falls from the
// first window on, as the wave of a sudden start does, and what rises to the last strain and does not fall again, is no
// peak.
inline constexpr double kPeakSmoothing = 0.01;
inline constexpr double kSalient = 0.15;

/// The salient peaks of the impact plate's stress up to the strain `last`, by strain. The plateau is the mean from 0 to
/// `last`. `last` is the strain of densification, where there is one, so that what is crushed solid counts for none.
std::vector<Peak> find_salient_peaks(std::span<const Sample> samples, double last);

}  // namespace cellcrush::validation
