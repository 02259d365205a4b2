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
      {Fidelity::draft, "DRAFT", 1, 1.06, {{fast, 0.114, 0.028, 0.026}, {slow, 0.027, 0.085, 0.027}}},
      {Fidelity::standard, "STANDARD", 2, 1.0, {{fast, 0.004, 0.012, 0.010}, {slow, 0.004, 0.053, 0.017}}},
      {Fidelity::reference, "REFERENCE", 8, 0.80, {{fast, 0.0, 0.008, 0.007}, {slow, 0.0, 0.039, 0.004}}},
  };
  return kPoints;
}

}  // namespace cellcrush
