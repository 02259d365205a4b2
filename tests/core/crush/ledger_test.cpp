// How far the ledger opens, as a share of the work: at the default step, and at half of it. Every lattice of Example 2
// on its default mesh and on others, in both directions, at three speeds, to 41 % strain. Blind to: friction, hardening
// and what lies past that strain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

struct Row {
  const char* lattice;
  LoadingSpec::Direction direction;
  int elements;  ///< per wall; 0: default
  double speed;  ///< m/s

  friend void PrintTo(const Row& row, std::ostream* out) { *out << row.lattice; }
};

constexpr auto kX = LoadingSpec::Direction::x;
constexpr auto kY = LoadingSpec::Direction::y;

std::string name_of(const Row& row) {
  return std::string(row.lattice) + (row.direction == kX ? "_x_" : "_y_") +
         (row.elements == 0 ? "default" : std::to_string(row.elements)) + "_at_" +
         std::to_string(std::lround(row.speed));
}

/// Greatest residual of a crush over the work at its end, in %.
double residual_of(SceneSpec spec) {
  Simulation simulation(scenes::build(spec));
  double most = 0.0;
  double work = 0.0;
  scenes::watch(simulation, [&](const Sample& sample) {
    most = std::max(most, std::abs(sample.energies.residual));
    work = sample.energies.external;
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return 100.0 * most / work;
}

SceneSpec at_share_of_step(SceneSpec spec, double share) {
  spec.numerics.time_step_s = share * scenes::build(spec)->schedule.time_step;
  return spec;
}

class Ledger : public testing::TestWithParam<Row> {};

TEST_P(Ledger, OpensByAFewThousandthsAndClosesWithTheStep) {
  const Row& row = GetParam();
  SceneSpec spec = scenes::spec_of({row.lattice, row.speed, 0.0}, 12, 7);
  spec.elements_per_wall.reset();
  if (row.elements > 0) spec.elements_per_wall = row.elements;
  spec.loading.direction = row.direction;
  spec.loading.end_strain = 0.41;
  scenes::record_bound("residual in %", residual_of(spec), 0.6);
  scenes::record_bound("residual at half the step in %", residual_of(at_share_of_step(spec, 0.5)), 0.2);
}

const Row kShort[] = {{"hexagon", kX, 0, 100.0}, {"square", kX, 4, 100.0}};

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  for (const double speed : {50.0, 100.0, 200.0}) {
    for (const int elements : {2, 4, 8, 16}) {
      rows.push_back({"hexagon", kX, elements, speed});
      rows.push_back({"hexagon", kY, elements, speed});
    }
    for (const char* lattice : {"square", "triangle"}) {
      for (const auto direction : {kX, kY}) rows.push_back({lattice, direction, 0, speed});
    }
  }
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Short, Ledger, testing::ValuesIn(kShort),
                         [](const auto& test) { return name_of(test.param); });
INSTANTIATE_TEST_SUITE_P(Long, Ledger, testing::ValuesIn(all_rows()),
                         [](const auto& test) { return name_of(test.param); });

TEST(LedgerOfTypeI, ClosesWithTheStep) {
  for (const double speed : {50.0, 100.0, 200.0}) {
    SceneSpec spec = scenes::preset("type-i");
    spec.loading.speed_m_per_s = speed;
    spec.loading.end_strain = 0.41;
    const std::string at = " at " + std::to_string(std::lround(speed)) + " m/s";
    scenes::record_bound("residual in %" + at, residual_of(spec), 0.6);
    scenes::record_bound("residual at half the step in %" + at, residual_of(at_share_of_step(spec, 0.5)), 0.2);
    spec.numerics.time_step_s = 1.73e-7;
    if (speed == 100.0) scenes::record_bound("residual in steps of 1.73e-7 s in %", residual_of(spec), 0.1);
  }
}

}  // namespace
}  // namespace cellcrush
