#include "scenes/placed_pairs.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes/direction.h"

namespace cellcrush::scenes {

double PlacedPair::distance() const { return std::hypot(std::max({0.0, -ahead, ahead - length}), across); }

double PlacedPair::to_start() const { return std::hypot(ahead, across); }

double PlacedPair::to_end() const { return std::hypot(ahead - length, across); }

Vector2 PlacedPair::ball() const { return start + ahead * axis + across * normal_of(axis); }

std::vector<PlacedPair> draw_pairs(std::size_t count) {
  std::mt19937 generator(23);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<PlacedPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const double length = 0.5 + 2.0 * unit(generator);
    const double reach = 0.2 + 0.3 * unit(generator);
    const double ahead = -0.5 + (length + 1.0) * unit(generator);
    const double across = 1.8 * reach * (2.0 * unit(generator) - 1.0);
    pairs.push_back({{10.0 * unit(generator), 10.0 * unit(generator)},
                     direction(6.28 * unit(generator)),
                     length,
                     ahead,
                     across,
                     reach});
  }
  return pairs;
}

PairScene::PairScene(const std::vector<PlacedPair>& pairs) {
  std::mt19937 generator(29);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int particle = 0;
  for (const PlacedPair& pair : pairs) {
    scene.elements.push_back({particle, particle + 1, pair.reach, 0});
    particle += 3;
    state.axis.push_back(pair.axis);
    state.length.push_back(pair.length);
    for (const Vector2& position : {pair.start, pair.end(), pair.ball()}) {
      state.position.push_back(position);
      state.velocity.emplace_back(unit(generator) - 0.5, unit(generator) - 0.5);
      scene.inverse_mass.push_back(1.0 + unit(generator));
    }
  }
}

}  // namespace cellcrush::scenes
