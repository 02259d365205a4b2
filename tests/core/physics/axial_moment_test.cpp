// Axial force and moment together: what no gate of pure bending sees.
#include "scenes/axial_moment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scenes/evidence.h"

namespace cellcrush {
namespace {

using AreaRule = SectionSpec::AreaRule;

// The figures are those of the 6 points through the depth; 1 - n^2 is exact.
TEST(AxialForceWithMoment, RootOfAPulledCantileverYieldsAtTheMomentThatItsAxialForceLeaves) {
  for (const auto& [n, of_rule] : {std::pair(0.0, 0.999), {0.3, 0.909}, {0.5, 0.726}, {0.7, 0.517}}) {
    const double of_pair = scenes::root_moment_of_pulled_cantilever(n, 2, AreaRule::constant_area);
    EXPECT_NEAR(of_pair, of_rule, 0.005) << "n = " << n;
    EXPECT_NEAR(of_pair, 1.0 - n * n, 0.03) << "n = " << n;
    scenes::record_figure("root moment at n = " + std::to_string(n).substr(0, 3), of_pair, 3);
    for (const int elements : {1, 8}) {
      const double moment = scenes::root_moment_of_pulled_cantilever(n, elements, AreaRule::constant_area);
      EXPECT_NEAR(moment / of_pair, 1.0, 0.005) << elements << " elements, n = " << n;
    }
  }
}

TEST(AxialForceWithMoment, FoldedStrutHasTheForceOfItsThreeHinges) {
  const std::vector<double> deflections = {0.5, 1.0, 2.0, 4.0};
  const std::vector<double> most = {0.69, 0.44, 0.25, 0.127};
  const std::vector<double> of_eight = scenes::forces_of_folded_strut(8, deflections);
  for (const int elements : {2, 4}) {
    const std::vector<double> forces = scenes::forces_of_folded_strut(elements, deflections);
    double worst = 0.0;
    for (std::size_t i = 0; i < deflections.size(); ++i) {
      const double rigid_plastic = std::sqrt(1.0 + deflections[i] * deflections[i]) - deflections[i];
      EXPECT_LT(forces[i], most[i]) << elements << " elements, w / h = " << deflections[i];
      EXPECT_NEAR(forces[i] / rigid_plastic, 1.0, 0.02) << elements << " elements, w / h = " << deflections[i];
      EXPECT_NEAR(forces[i] / of_eight[i], 1.0, 0.02) << elements << " elements, w / h = " << deflections[i];
      worst = std::max(worst, std::abs(forces[i] / rigid_plastic - 1.0));
    }
    scenes::record_figure(std::to_string(elements) + " elements: worst error in %", 100.0 * worst, 2);
  }
}

// A pulled beam keeps its area (E5c). If it thinned, it would neck in its shortest elements.
TEST(AxialForceWithMoment, HeldBeamPassesFromBendingToPull) {
  const std::vector<double> deflections = {0.5, 1.0, 1.5, 2.0};
  const std::vector<double> of_two = scenes::loads_of_held_beam(2, 20.0, deflections);
  double worst = 0.0;
  for (const int elements : {2, 4, 8}) {
    const std::vector<double> loads = scenes::loads_of_held_beam(elements, 20.0, deflections);
    for (std::size_t i = 0; i < deflections.size(); ++i) {
      const double w = deflections[i];
      const double rigid_plastic = w < 1.0 ? 1.0 + w * w : 2.0 * w;
      EXPECT_NEAR(loads[i] / rigid_plastic, 1.0, 0.02) << elements << " elements, W / h = " << w;
      EXPECT_NEAR(loads[i] / of_two[i], 1.0, 0.02) << elements << " elements, W / h = " << w;
      worst = std::max(worst, std::abs(loads[i] / rigid_plastic - 1.0));
    }
  }
  scenes::record_figure("worst error in %", 100.0 * worst, 2);
}

}  // namespace
}  // namespace cellcrush
