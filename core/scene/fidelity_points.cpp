#include "cellcrush/fidelity.h"

namespace cellcrush {

// The numbers are those of tests/bench/results/work_precision.csv.
const std::vector<FidelityPoint>& fidelity_points() {
  using Fidelity = NumericsSpec::Fidelity;
  const std::string fast = "Type I at 100 m/s";
  const std::string slow = "Example 1 at 1 m/s";
  static const std::vector<FidelityPoint> kPoints = {
      {Fidelity::draft, "DRAFT", 1, 3, 4, 0.8, {{fast, 0.5, 0.03, 0.03}, {slow, 0.5, 0.03, 0.03}}},
      {Fidelity::standard, "STANDARD", 2, 4, 6, 1.0, {{fast, 0.1, 0.03, 0.03}, {slow, 0.02, 0.03, 0.03}}},
      {Fidelity::reference, "REFERENCE", 4, 4, 6, 0.9, {{fast, 0.01, 0.02, 0.03}, {slow, 0.01, 0.01, 0.03}}},
  };
  return kPoints;
}

}  // namespace cellcrush
