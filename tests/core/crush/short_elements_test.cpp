#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <variant>

#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

// Squares of Example 2 whose elements are 0.6 of the thickness long. Walls are squashed, fold and unload. If the
// modulus of squashed pairs is bounded as that of elements, the first of these crushes heats by 7 % of its work.
TEST(ShortElements, OfSquashedWallsMakeNoEnergy) {
  double worst = 0.0;
  for (const int seed : {1, 2, 3}) {
    SceneSpec spec = scenes::preset("type-ii-as-counted");
    RegularLattice& lattice = scenes::cells_of(spec);
    lattice.columns = 6;
    lattice.rows = 3;
    spec.elements_per_wall = 32;
    spec.imperfection = {0.01, static_cast<std::uint64_t>(seed)};
    spec.loading.speed_m_per_s = 150.0;
    spec.loading.end_strain = 0.41;
    Simulation simulation(scenes::build(spec));
    Sample sample;
    while (simulation.status().kind == RunStatus::Kind::running) {
      simulation.advance(simulation.scene().schedule.sample_interval);
      sample = simulation.take_sample();
    }
    EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
    EXPECT_LT(std::abs(sample.energies.residual), 0.005 * sample.energies.external) << "seed " << seed;
    worst = std::max(worst, std::abs(sample.energies.residual / sample.energies.external));
  }
  scenes::record_bound("residual in %", 100.0 * worst);
}

}  // namespace
}  // namespace cellcrush
