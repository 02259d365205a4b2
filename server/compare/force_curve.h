#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "compare/measurement.h"

namespace cellcrush::compare {

/// A point of a curve as it was recorded, on the way there or back.
struct CurvePoint {
  double x = 0.0;
  double y = 0.0;
};

/// Which parts of a job a curve is of. Names are of a rigid wall ("press"), or of a grip or a watched node with a
/// direction ("foot.y"); forces of several are added ("left.y+right.y").
class ForceParts {
 public:
  ForceParts(const std::string& force, const std::string& displacement);
  /// Throws InvalidField, with what the job has, if it has no such parts.
  void check(const v1::Sample& sample) const;
  /// REQUIRES: checked.
  [[nodiscard]] CurvePoint point_of(const v1::Sample& sample) const;

 private:
  std::vector<std::string> forces_;
  std::string displacement_;
};

/// The loading of recorded points, whose displacement becomes positive. Throws ServiceError (failed_precondition) if
/// nothing has moved.
LoadCurve loading_of(const std::vector<CurvePoint>& points);

/// Turns the sign of the computed force, if it opposes that of the test for the most part: tests have the force of a
/// load cell, samples that on the lattice.
void align_sign(const LoadCurve& test, LoadCurve& computed);

}  // namespace cellcrush::compare
