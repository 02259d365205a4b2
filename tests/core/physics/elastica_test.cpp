#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

using scenes::Cantilever;

struct Tip {
  double deflection;  // v / L, along the load
  double shortening;  // u / L, toward the clamp
};

/// Where the tip of a cantilever comes to rest under a dead load P on it, with P L^2 / EI given.
Tip rest_under(double load_number, int elements) {
  const double load = load_number * Cantilever::kStiffness / (Cantilever::kLength * Cantilever::kLength);
  const double settle = 18.0 / Cantilever::first_frequency();
  const auto scene =
      scenes::build(Cantilever::spec(elements, FrameLattice::Component::y, load, 0.1 * settle, 1.1 * settle));
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  const Vector2 tip = simulation.state().position[1];
  return {tip.y() / Cantilever::kLength, 1.0 - tip.x() / Cantilever::kLength};
}

struct Exact {
  double load_number;
  Tip tip;
};
// Elliptic integrals of the inextensible elastica.
const std::vector<Exact> kExact = {{1.0, {0.3017208, 0.0564332}},
                                   {2.0, {0.4934575, 0.1606417}},
                                   {5.0, {0.7137915, 0.3876284}},
                                   {10.0, {0.8106090, 0.5549956}}};

TEST(Elastica, CantileverUnderDeadLoadIsExactWithinAThousandthAt32Elements) {
  double worst = 0.0;
  for (const Exact& exact : kExact) {
    const Tip tip = rest_under(exact.load_number, 32);
    worst = std::max(
        {worst, std::abs(tip.deflection - exact.tip.deflection), std::abs(tip.shortening - exact.tip.shortening)});
    EXPECT_NEAR(tip.deflection, exact.tip.deflection, 1e-3) << "P L^2 / EI = " << exact.load_number;
    EXPECT_NEAR(tip.shortening, exact.tip.shortening, 1e-3) << "P L^2 / EI = " << exact.load_number;
  }
  scenes::record_figure("worst error over L", worst, 2);
}

TEST(Elastica, ErrorFallsAsTheSquareOfTheElements) {
  const Exact& exact = kExact[2];
  std::vector<double> error;
  for (const int elements : {4, 8, 16}) {
    const Tip tip = rest_under(exact.load_number, elements);
    error.push_back(std::hypot(tip.deflection - exact.tip.deflection, tip.shortening - exact.tip.shortening));
  }
  for (std::size_t i = 1; i < error.size(); ++i) {
    const double order = std::log2(error[i - 1] / error[i]);
    scenes::record_figure("order " + std::to_string(i), order, 3);
    EXPECT_GT(order, 1.8) << error[i - 1] << " to " << error[i];
    EXPECT_LT(order, 2.3) << error[i - 1] << " to " << error[i];
  }
}

}  // namespace
}  // namespace cellcrush
