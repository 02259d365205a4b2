#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cellcrush::compare {

/// What a curve is of: nominal stress in MPa over nominal strain, or force in N over displacement in mm.
enum class CurveKind { stress_strain, force_displacement };

/// A curve of loading. x ascends; compression is positive.
struct LoadCurve {
  std::vector<double> x;  ///< strain or displacement
  std::vector<double> y;  ///< stress or force

  /// Linear between its points. REQUIRES: x.front() <= at <= x.back().
  [[nodiscard]] double at(double at) const;

  /// Adds a point, if it is further than the last one: unloading is left out.
  void add(double at, double value);
};

/// The lattice of a job before loading: makes strain of displacement and stress of force.
struct Specimen {
  double length_mm = 0.0;
  double area_mm2 = 0.0;  ///< width across the crush times depth
};

/// A test as a file tells it: its loading, up to its greatest strain or displacement.
struct Measurement {
  std::string name;  ///< of the file
  LoadCurve curve;
};

/// Reads a test from the text of a CSV file: columns between commas, semicolons or tabs, numbers with decimal points or
/// commas, lines with # left out. The header, or `columns` in its place, names the columns and their units, as in
/// "displacement (mm);force (kN)"; a row of units may follow it. One column is strain or displacement, one is stress or
/// force; others are left out. Compression may be negative. Without a specimen the file has displacement and force;
/// the force keeps its sign, unless both are negative for the most part. Throws InvalidField, which names file, line
/// and remedy.
Measurement read_measurement(const std::string& text, const std::string& file, const std::string& columns,
                             const std::optional<Specimen>& specimen);

}  // namespace cellcrush::compare
