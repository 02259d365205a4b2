#include "scenes/small_specimen.h"

#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush::scenes {

SceneSpec spec_of(const SmallSpecimen& specimen, int columns, int rows) {
  constexpr double kSide = 4.0;  // mm
  constexpr int kElementsAlongCrush = 8;
  SceneSpec spec = hexagon_specimen(columns, rows);
  const std::string lattice = specimen.lattice;
  if (lattice == "square") {
    spec.lattice = scenes::squares(columns, rows, kSide, 0.05132 * kSide);
    spec.elements_per_wall = kElementsAlongCrush;
  } else if (lattice == "triangle") {
    spec.lattice = scenes::triangles(columns, rows, kSide, 0.02963 * kSide);
    spec.elements_per_wall = kElementsAlongCrush;
  } else if (lattice == "thick") {
    spec.lattice = scenes::hexagons(columns, rows, kSide, 0.25, 0.5);
  } else if (lattice == "thick_ends") {
    spec.lattice = scenes::hexagons(columns, rows, kSide, 0.5, 0.9);
    spec.loading.direction = LoadingSpec::Direction::y;
    spec.elements_per_wall = 2;
  }
  if (specimen.elements > 0) {
    spec.elements_per_wall = specimen.elements;
  }
  spec.loading.speed_m_per_s = specimen.speed;
  spec.contact.friction = spec.plates.friction = specimen.friction;
  spec.imperfection = {0.01, 1};
  spec.numerics.time_step_s = 0.0;
  return spec;
}

std::string name_of(const testing::TestParamInfo<SmallSpecimen>& test) {
  return std::string(test.param.lattice) + "At" + std::to_string(static_cast<int>(test.param.speed)) +
         (test.param.friction > 0.0 ? "WithFriction" : "") +
         (test.param.elements > 0 ? "Of" + std::to_string(test.param.elements) + "Elements" : "");
}

}  // namespace cellcrush::scenes
