#include "server/brick_network.h"

#include <cstdint>
#include <random>

#include "programs/text_proto.h"

namespace cellcrush::testing {

v1::Case brick_network(int columns, int rows) {
  auto out = from_text<v1::Case>(R"(
    title: "Bricks"
    depth_mm: 1 elements_per_wall: 1
    material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
    loading { speed_m_per_s: 100 end_strain: 0.0001 }
    output { sample_count: 10 frame_count: 1 })");
  v1::Lattice::Network& network = *out.mutable_lattice()->mutable_network();
  std::mt19937 random(7);
  const auto add_uneven = [&](double size, double spread, auto& list) {
    const auto range = static_cast<std::uint32_t>(2e6 * spread);
    const auto millionths =
        static_cast<std::int64_t>(1e6 * (size - spread)) + static_cast<std::int64_t>(random() % range);
    list.Add(static_cast<double>(millionths) / 1e6);
  };
  const auto add_wall = [&](int start, int end) {
    network.add_walls(start);
    network.add_walls(end);
    add_uneven(0.03, 0.005, *network.mutable_thicknesses_mm());
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int joint = row * columns + column;
      add_uneven(1.0 * column, 0.2, *network.mutable_joints_mm());
      add_uneven(1.0 * row, 0.2, *network.mutable_joints_mm());
      if (column > 0) add_wall(joint - 1, joint);
      if (row > 0 && (row + column) % 2 == 0) add_wall(joint - columns, joint);
    }
  }
  return out;
}

}  // namespace cellcrush::testing
