#include "scene/lattice_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <string>

#include "cellcrush/presets.h"
#include "cellcrush/simulation.h"
#include "scene/check_spec.h"
#include "scene/mesh_part.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

/// What the quick way and the whole mesh say, and how often the quick way said something.
struct Tally {
  LatticeMeasurer measurer;
  int decided = 0;
  int undecided = 0;
  int refused = 0;  // undecided, and walls lie in each other

  /// Every number to the last bit.
  void compare(const SceneSpec& spec, const std::string& what) {
    const SceneSpec part = mesh_part_of(spec);
    const auto quick = measurer.measure(part);
    const MeshMeasures whole = measure_mesh(part, *build_mesh(part));
    if (!quick) {
      ++undecided;
      refused += whole.overlaps.empty() ? 0 : 1;
      return;
    }
    ++decided;
    EXPECT_EQ(whole.overlaps.size(), 0u) << what << ": " << whole.overlaps.front().message;
    EXPECT_EQ(quick->overlaps.size(), 0u) << what;
    EXPECT_EQ(quick->particle_count, whole.particle_count) << what;
    EXPECT_EQ(quick->element_count, whole.element_count) << what;
    EXPECT_EQ(quick->length, whole.length) << what;
    EXPECT_EQ(quick->stable_step, whole.stable_step) << what;
    EXPECT_EQ(quick->lightest_mass, whole.lightest_mass) << what;
    EXPECT_EQ(quick->shortest_element, whole.shortest_element) << what;
    EXPECT_EQ(quick->thinnest_wall, whole.thinnest_wall) << what;
    EXPECT_EQ(quick->hardening, whole.hardening) << what;
    EXPECT_EQ(quick->contact, whole.contact) << what;
    EXPECT_EQ(quick->material.youngs_modulus, whole.material.youngs_modulus) << what;
    EXPECT_EQ(quick->material.yield_stress, whole.material.yield_stress) << what;
    EXPECT_EQ(quick->material.density, whole.material.density) << what;
  }
};

/// Specs over all that the mesh of a regular lattice depends on, small enough to be built by the hundred.
class RandomLattices {
 public:
  explicit RandomLattices(unsigned seed) : random_(seed) {}

  SceneSpec next() {
    SceneSpec spec = scenes::hexagon_block(3, 3);
    spec.numerics.time_step_s = 0.0;
    const double side = one_in(2) ? 4.0 : between(0.3, 40.0);
    const double thickness = side * (one_in(3) ? between(0.2, 0.5) : between(0.001, 0.2));
    const int columns = whole(2, 12);
    const int rows = whole(1, 9);
    spec.elements_per_wall = one_in(4) ? whole(1, 20) : whole(1, 4);
    switch (whole(0, 2)) {
      case 0: spec.lattice = hexagons(columns, rows, side, thickness, spec.inclusions); break;
      case 1: spec.lattice = SquareLattice{columns, rows, side, thickness}; break;
      default: spec.lattice = TriangleLattice{columns, rows, side, thickness};
    }
    if (!one_in(3)) {
      const double amplitude = side * (one_in(2) ? between(0.03, 0.1) : between(0.0, 0.02));
      spec.imperfection = {std::min(amplitude, 0.1 * side), static_cast<std::uint64_t>(whole(0, 1000000))};
    }
    spec.depth_mm = between(0.5, 20.0);
    spec.material.density_kg_per_m3 = between(500.0, 9000.0);
    spec.material.plane = one_in(2) ? MaterialSpec::Plane::stress : MaterialSpec::Plane::strain;
    spec.numerics.mass_scaling = one_in(2) ? 1.0 : between(1.0, 100.0);
    spec.numerics.rotary_scaling = one_in(2) ? 1.0 : between(1.0, 100.0);
    spec.loading.direction = one_in(2) ? LoadingSpec::Direction::x : LoadingSpec::Direction::y;
    return spec;
  }

 private:
  HexagonLattice hexagons(int columns, int rows, double side, double thickness, Inclusions& inclusions) {
    HexagonLattice lattice = {columns, rows, side, thickness, std::nullopt};
    if (one_in(2)) {
      lattice.vertical_wall_thickness_mm = one_in(3) ? 2.0 * thickness : side * between(0.001, 0.3);
    }
    const double thickest = std::max(thickness, lattice.vertical_wall_thickness_mm.value_or(0.0));
    lattice.wall_thickness_mm = std::min(thickness, 0.5 * side);
    if (lattice.vertical_wall_thickness_mm) {
      lattice.vertical_wall_thickness_mm = std::min(*lattice.vertical_wall_thickness_mm, 0.5 * side);
    }
    if (one_in(2) && rows > 1) {
      const int count = whole(1, rows - 1);
      for (int i = 0; i < count; ++i) {
        inclusions.rows.push_back(whole(1, rows - 1));
      }
      inclusions.thickness_factor = std::max(1.0, std::min(between(1.0, 4.0), 0.49 * side / thickest));
      inclusions.model = one_in(2) ? Inclusions::Model::rigid : Inclusions::Model::meshed;
    }
    return lattice;
  }

  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_in(int count) { return whole(1, count) == 1; }

  std::mt19937 random_;
};

std::string name_of(int number) { return "spec " + std::to_string(number); }

TEST(LatticeMeasures, AreThoseOfTheWholeMeshToTheLastBit) {
  RandomLattices lattices(1);
  Tally tally;
  for (int i = 0; i < 3000; ++i) {
    SceneSpec spec = lattices.next();
    if (!check_spec(spec).empty()) {
      continue;
    }
    tally.compare(spec, name_of(i));
    // The same pattern with other walls and other joints.
    spec.depth_mm = 2.0 * *spec.depth_mm;
    tally.compare(spec, name_of(i) + ", deeper");
    if (spec.imperfection.amplitude_mm > 0.0) {
      ++spec.imperfection.seed;
      tally.compare(spec, name_of(i) + ", another seed");
    }
  }
  std::cout << tally.decided << " decided, " << tally.undecided << " undecided, of which " << tally.refused
            << " refused\n";
  EXPECT_GT(tally.decided, 5 * tally.undecided);
  EXPECT_GT(tally.undecided, 100);
  EXPECT_GT(tally.refused, 10);
}

}  // namespace
}  // namespace cellcrush
