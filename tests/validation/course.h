#pragma once

#include <span>
#include <string>
#include <vector>

#include "cellcrush/sample.h"
#include "validation/peaks.h"

namespace cellcrush::validation {

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

/// Names of the columns of the row that course_row gives, and the row: peaks as strain:stress:prominence, separated by
/// blanks. A crush that has not densified, or risen, has a > before its last strain.
std::string course_names();
std::string course_row(const std::string& name, const Course& course);

}  // namespace cellcrush::validation
