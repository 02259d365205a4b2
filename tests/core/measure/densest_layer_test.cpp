#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/crush_mode.h"
#include "measure/layers.h"
#include "measure/theory.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "scenes/presets.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// A lattice of one of the presets whose particles are moved along the crush at will.
struct Moved {
  std::shared_ptr<Scene> scene;
  double pitch;
  State state;

  template <class PlaceOf>
  Moved(const char* preset, const PlaceOf& place_of)
      : scene(scenes::build(scenes::preset(preset))),
        pitch(find_cells(*scene).field.pitch),
        state(make_initial_state(*scene)) {
    const int axis = scene->plates.axis;
    for (Vector2& position : state.position) {
      position[axis] = place_of(position[axis]);
    }
    scenes::follow_positions(*scene, state);
  }

  [[nodiscard]] DensestLayer find() const { return find_densest_layer(*scene, state, size_of_layers(*scene, pitch)); }

  /// Length times thickness of the walls now, mm^2.
  [[nodiscard]] double metal() const {
    double sum = 0.0;
    for (std::size_t e = 0; e < scene->element_count(); ++e) {
      sum += state.length[e] * scene->elements[e].thickness;
    }
    return sum;
  }
};

// Pressed evenly together, all layers are alike but for the cells that they cut, the more so the more cells fit in one.
TEST(DensestLayer, OfAnEvenlyCompactedLatticeHasItsSolidFraction) {
  for (const char* preset : {"hexagon-small", "type-i", "type-ii-as-counted", "type-iii-as-counted"}) {
    constexpr double kLeft = 0.05;
    const Moved crushed(preset, [](double place) { return kLeft * place; });
    const double even = crushed.metal() / (kLeft * crushed.scene->length * crushed.scene->width);
    EXPECT_GT(even, 1.0) << preset;
    EXPECT_NEAR(crushed.find().solid_fraction, even, 0.05 * even) << preset;
    scenes::record_bound("evenly compacted in %", 100.0 * std::abs(crushed.find().solid_fraction / even - 1.0));
  }
}

TEST(DensestLayer, IsFoundWhereTheLatticeIsCompacted) {
  for (const double middle : {0.2, 0.5, 0.8}) {
    // A tenth of the length is pressed together to a twelfth.
    const auto squeeze = [&](double place) {
      const double length = 20.0 * 4.0 * std::sqrt(3.0);
      const double from = (middle - 0.05) * length;
      const double inside = std::clamp(place - from, 0.0, 0.1 * length);
      return place - (1.0 - 1.0 / 12.0) * inside;
    };
    const Moved crushed("hexagon-small", squeeze);
    const DensestLayer layer = crushed.find();
    EXPECT_GT(layer.solid_fraction, 3.0 * relative_density_of(*crushed.scene));
    EXPECT_NEAR(layer.place / crushed.scene->length, middle, 0.06);
  }
}

// Layers of thin foil are far thinner than a cell, and may have a single joint in them.
TEST(DensestLayer, OfThinFoilIsNotADisplacedJoint) {
  SceneSpec spec = scenes::hexagon_specimen(9, 12);
  RegularLattice& lattice = scenes::cells_of(spec);
  lattice.side_mm = 2.75;
  lattice.wall_thickness_mm = 0.0254;
  lattice.own["vertical_wall_thickness_mm"] = 0.0508;
  spec.imperfection = {0.05, 1};
  const auto scene = scenes::build(spec);
  State state = make_initial_state(*scene);
  state.position[scene->joint_count / 2].x() += 0.6;
  scenes::follow_positions(*scene, state);
  const LayerSize size = size_of_layers(*scene, find_cells(*scene).field.pitch);
  EXPECT_GT(find_densest_layer(*scene, state, {size.depth, 0.0}).solid_fraction, 1.0) << "a joint on its own";
  EXPECT_LT(find_densest_layer(*scene, state, size).solid_fraction, 20.0 * relative_density_of(*scene));
}

TEST(DensestLayer, OfWallsThatHaveGrownIsDenser) {
  Moved crushed("hexagon-small", [](double place) { return 0.1 * place; });
  const double before = crushed.find().solid_fraction;
  for (std::size_t e = 0; e < crushed.scene->element_count(); ++e) {
    crushed.state.thickening[e] = 0.1 * crushed.scene->elements[e].thickness;
  }
  EXPECT_NEAR(crushed.find().solid_fraction, 1.2 * before, 0.01 * before);
}

}  // namespace
}  // namespace cellcrush
