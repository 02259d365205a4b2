#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush::validation {

/// Writes a curve as it comes, a row a sample: strain, the plate's travel in mm, the plates' stresses in MPa, the
/// energies in N mm, with six digits.
class CurveFile {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  explicit CurveFile(const std::string& file);
  void add(Sample sample);

 private:
  std::ofstream stream_;
};

/// The samples of such a file, with what stands in it; a last row that was cut short is left out. Throws
/// std::runtime_error when the file is missing or has other columns.
std::vector<Sample> read_curve(const std::string& file);

}  // namespace cellcrush::validation
