#include "scenes/small_block.h"

#include "scenes/frames.h"

namespace cellcrush::scenes {

SceneSpec spec_of(const SmallBlock& block, int columns, int rows) {
  constexpr double kSide = 4.0;  // mm
  SceneSpec spec = hexagon_block(columns, rows);
  const std::string lattice = block.lattice;
  if (lattice == "square") {
    spec.lattice = SquareLattice{columns, rows, kSide, 0.05132 * kSide};
  } else if (lattice == "triangle") {
    spec.lattice = TriangleLattice{columns, rows, kSide, 0.02963 * kSide};
  } else if (lattice == "thick") {
    spec.lattice = HexagonLattice{columns, rows, kSide, 0.25, 0.5};
  } else if (lattice == "thick_ends") {
    spec.lattice = HexagonLattice{columns, rows, kSide, 0.5, 0.9};
    spec.loading.direction = LoadingSpec::Direction::y;
  }
  spec.loading.speed_m_per_s = block.speed;
  spec.contact.friction = spec.plates.friction = block.friction;
  spec.imperfection = {0.01, 1};
  spec.numerics.time_step_s = 0.0;
  return spec;
}

std::string name_of(const testing::TestParamInfo<SmallBlock>& test) {
  return std::string(test.param.lattice) + "At" + std::to_string(static_cast<int>(test.param.speed)) +
         (test.param.friction > 0.0 ? "WithFriction" : "");
}

}  // namespace cellcrush::scenes
