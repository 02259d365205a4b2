#include "cellcrush/fidelity.h"

namespace cellcrush {

// The number of elements per wall trades time for accuracy at every speed, so it is all that a fidelity sets. A
// threefold rotary inertia pays in slow crushes only. REFERENCE is the solution from which errors are measured; its own
// error is known up to the scatter of its seeds. Four elements per wall are no point of the front: they were found no
// closer to REFERENCE than two.
const std::vector<FidelityPoint>& fidelity_points() {
  using Fidelity = NumericsSpec::Fidelity;
  const std::string fast = "support plateau, Type I, 100 m/s";
  const std::string slow = "limit stress, Example 1, 1 m/s";
  // From tests/bench/results/work_precision.csv.
  static const std::vector<FidelityPoint> kPoints = {
      {Fidelity::draft, "DRAFT", 1, 1.06, {{fast, 0.1136, 0.0282, 0.0264}, {slow, 0.0199, 0.0019, 0.001}}},
      {Fidelity::standard, "STANDARD", 2, 1.0, {{fast, 0.0036, 0.0123, 0.0098}, {slow, 0.0083, 0.0021, 0.001}}},
      {Fidelity::reference, "REFERENCE", 8, 0.80, {{fast, 0.0, 0.0085, 0.0068}, {slow, 0.0, 0.0021, 0.0017}}},
  };
  return kPoints;
}

}  // namespace cellcrush
