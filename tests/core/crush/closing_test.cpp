// Up to the strain at which a lattice is closed (scene/solid_area.h) its work depends neither on the mesh nor on the
// contact stiffness: meshes of 4 and 8 elements a wall, stiffness from a quarter to four times that in use.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush {
namespace {

struct Lattice {
  const char* kind;
  double slenderness;  ///< thickness of a wall over its length
  int cells = 6;       ///< along and across
  bool hardens = true;
};

std::string name_of(const Lattice& lattice) {
  const auto percent = static_cast<int>(std::lround(100.0 * lattice.slenderness));
  return std::string(lattice.kind) + " " + std::to_string(percent) + (lattice.cells == 6 ? "" : " few");
}

SceneSpec spec_of(const Lattice& lattice, int elements, double stiffness) {
  constexpr double kSide = 4.0;  // mm
  SceneSpec spec = scenes::spec_of({"hexagon", 100.0, 0.0}, lattice.cells, lattice.cells);
  const double thickness = lattice.slenderness * kSide;
  spec.lattice = RegularLattice{lattice.kind, lattice.cells, lattice.cells, kSide, thickness, {}};
  spec.imperfection = {0.05 * kSide, 1};  // decides how the walls buckle, whatever the mesh
  if (lattice.hardens) spec.material.hardening_modulus_mpa = 0.01 * *spec.material.youngs_modulus_mpa;
  spec.elements_per_wall = elements;
  spec.contact.stiffness_factor *= stiffness;
  spec.loading.end_strain.reset();
  return spec;
}

/// Work of a run to closing, N mm.
double work_of(const SceneSpec& given) {
  SceneSpec spec = given;
  spec.loading.end_strain = facts_of(*scenes::build(spec)).valid_to_strain;
  return scenes::run_frame(spec).back().energies.external;
}

/// Greatest difference of the work from that of 8 elements and the stiffness in use, in %.
double difference_of(const Lattice& lattice) {
  const double reference = work_of(spec_of(lattice, 8, 1.0));
  double most = 0.0;
  for (const int elements : {4, 8}) {
    for (const double stiffness : {0.25, 1.0, 4.0}) {
      most = std::max(most, std::abs(work_of(spec_of(lattice, elements, stiffness)) / reference - 1.0));
    }
  }
  return 100.0 * most;
}

class UntilClosed : public testing::TestWithParam<Lattice> {};

TEST_P(UntilClosed, WorkIsThatOfAnyMeshAndStiffness) {
  scenes::record_bound(name_of(GetParam()) + ": work in %", difference_of(GetParam()), 4.0);
}

constexpr auto kNames = [](const ::testing::TestParamInfo<Lattice>& test) {
  std::string name = name_of(test.param);
  std::ranges::replace(name, ' ', '_');
  return name;
};

INSTANTIATE_TEST_SUITE_P(Few, UntilClosed,
                         testing::Values(Lattice{"hexagon", 0.2, 3}, Lattice{"square", 0.2, 3},
                                         Lattice{"triangle", 0.1, 3}),
                         kNames);
INSTANTIATE_TEST_SUITE_P(Long, UntilClosed,
                         testing::Values(Lattice{"hexagon", 0.05}, Lattice{"hexagon", 0.1}, Lattice{"hexagon", 0.2},
                                         Lattice{"square", 0.05}, Lattice{"square", 0.1}, Lattice{"square", 0.2},
                                         Lattice{"triangle", 0.03}, Lattice{"triangle", 0.06},
                                         Lattice{"triangle", 0.1}),
                         kNames);

// What the measure does not tell: see the page on what is computed.
TEST(Unbounded, PerfectlyPlasticThinSquaresAndDenseTrianglesDifferByMore) {
  scenes::record_bound("squares in %", difference_of({"square", 0.05, 6, false}));
  scenes::record_bound("triangles in %", difference_of({"triangle", 0.2, 6, false}));
}

}  // namespace
}  // namespace cellcrush
