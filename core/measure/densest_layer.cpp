#include "measure/densest_layer.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "measure/theory.h"

namespace cellcrush {
namespace {

constexpr double kCells = 3.0;
constexpr double kThicknesses = 4.0;

struct Layer {
  double metal = 0.0;                                    ///< mm^2, length times thickness
  double moment = 0.0;                                   ///< mm^3, of the metal about the impact end before loading
  double low = std::numeric_limits<double>::infinity();  ///< extent across the crush, mm
  double high = -std::numeric_limits<double>::infinity();
};

/// Extent across the crush of a layer and of `reach` layers on either side of it.
double width_of(const std::vector<Layer>& layers, std::size_t at, std::size_t reach) {
  const std::size_t end = std::min(at + reach + 1, layers.size());
  double low = layers[at].low;
  double high = layers[at].high;
  for (std::size_t k = at - std::min(at, reach); k < end; ++k) {
    low = std::min(low, layers[k].low);
    high = std::max(high, layers[k].high);
  }
  return high - low;
}

}  // namespace

LayerSize size_of_layers(const Scene& scene, double pitch) {
  double thickest = 0.0;
  for (const Element& element : scene.elements) {
    thickest = std::max(thickest, element.thickness);
  }
  return {std::max(kCells * pitch * relative_density_of(scene), kThicknesses * thickest), 0.5 * pitch};
}

DensestLayer find_densest_layer(const Scene& scene, const State& state, const LayerSize& size) {
  const int axis = scene.plates.axis;
  const auto before = [axis](const Vector2& a, const Vector2& b) { return a[axis] < b[axis]; };
  const auto [first, last] = std::minmax_element(state.position.begin(), state.position.end(), before);
  const double begin = (*first)[axis];
  const double extent = (*last)[axis] - begin;
  const double origin = (*std::min_element(scene.position.begin(), scene.position.end(), before))[axis];
  const double most = static_cast<double>(scene.particle_count());
  std::vector<Layer> layers(static_cast<std::size_t>(std::clamp(extent / size.depth, 1.0, most)));
  const double per_depth = static_cast<double>(layers.size()) / extent;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const double half = 0.5 * element.thickness + (state.thickening.empty() ? 0.0 : state.thickening[e]);
    const double metal = state.length[e] * half;
    for (const int particle : {element.start, element.end}) {
      const Vector2& position = state.position[particle];
      const auto at = static_cast<std::size_t>(per_depth * (position[axis] - begin));
      Layer& layer = layers[std::min(at, layers.size() - 1)];
      layer.metal += metal;
      layer.moment += metal * (scene.position[particle][axis] - origin);
      layer.low = std::min(layer.low, position[1 - axis] - half);
      layer.high = std::max(layer.high, position[1 - axis] + half);
    }
  }
  const auto reach = static_cast<std::size_t>(std::max(1.0, size.reach * per_depth));
  DensestLayer densest;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const double fraction = layers[k].metal * per_depth / width_of(layers, k, reach);
    if (layers[k].metal > 0.0 && fraction > densest.solid_fraction) {
      densest = {fraction, layers[k].moment / layers[k].metal};
    }
  }
  return densest;
}

}  // namespace cellcrush
