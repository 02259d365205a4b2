#pragma once

#include <span>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush::validation {

/// A salient maximum of a curve.
struct Peak {
  double strain = 0.0;
  double stress = 0.0;  ///< MPa, smoothed
  /// MPa by which the curve must be left before it rises higher, to that side where it is less.
  double prominence = 0.0;
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

/// What a crush goes through up to where it is crushed solid.
struct Course {
  double densification = 0.0;         ///< strain of its onset; that of the last sample where there is none
  double densification_travel = 0.0;  ///< mm of the plate at it
  bool densified = false;
  /// mm of the plate from where on the stress stays above twice its mean up to there; that of the last sample where it
  /// does not.
  double rise_travel = 0.0;
  bool risen = false;
  double plateau = 0.0;     ///< MPa, impact plate, mean up to it
  std::vector<Peak> peaks;  ///< up to the rise, or to the onset if that is later
};

/// REQUIRES: samples is not empty.
Course find_course(std::span<const Sample> samples);

}  // namespace cellcrush::validation
