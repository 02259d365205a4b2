#include "cellcrush/fidelity.h"

namespace cellcrush {

// Of all that was charted only the elements a wall trade time for accuracy, so they are all that a fidelity is. REFERENCE is
// the solution from which errors are taken; its own is known to the scatter of its seeds. Four elements a wall are no point of
// the front: they were found no nearer to it than two.
const std::vector<FidelityPoint>& fidelity_points() {
  using Fidelity = NumericsSpec::Fidelity;
  const std::string fast = "Type I at 100 m/s";
  const std::string slow = "Example 1 at 1 m/s";
  // From tests/bench/results/work_precision.csv.
  static const std::vector<FidelityPoint> kPoints = {
      {Fidelity::draft, "DRAFT", 1, 0.8, {{fast, 0.5, 0.03, 0.03}, {slow, 0.5, 0.03, 0.03}}},
      {Fidelity::standard, "STANDARD", 2, 1.0, {{fast, 0.1, 0.03, 0.03}, {slow, 0.02, 0.03, 0.03}}},
      {Fidelity::reference, "REFERENCE", 8, 0.9, {{fast, 0.01, 0.02, 0.03}, {slow, 0.01, 0.01, 0.03}}},
  };
  return kPoints;
}

}  // namespace cellcrush
