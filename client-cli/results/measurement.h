#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cellcrush::client {

/// A stress-strain curve: nominal strain, and nominal stress in MPa, both positive in compression. The strain ascends.
struct StressCurve {
  std::vector<double> strain;
  std::vector<double> stress_mpa;

  /// Linear between its points. REQUIRES: strain.front() <= at <= strain.back().
  [[nodiscard]] double at(double at) const;
};

/// The lattice of a job before loading: makes strain of displacement and stress of force.
struct Specimen {
  double length_mm = 0.0;
  double area_mm2 = 0.0;  ///< width across the crush times depth
};

/// A test as a file tells it: its loading, up to its greatest strain.
struct Measurement {
  std::string name;  ///< of the file
  StressCurve curve;
};

/// Reads a test from the text of a CSV file: columns between commas, semicolons or tabs, numbers with decimal points or
/// commas, lines with # left out. The header, or `columns` in its place, names the columns and their units, as in
/// "displacement (mm);force (kN)"; a row of units may follow it. One column is strain or displacement, one is stress or
/// force; others are left out. Compression may be negative. Throws CommandError (refused), which names file, line and
/// remedy.
Measurement read_measurement(const std::string& text, const std::string& file, const std::string& columns,
                             const Specimen& specimen);

}  // namespace cellcrush::client
