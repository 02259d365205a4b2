#include "bench/array_bytes.h"

#include <algorithm>

#include "cellcrush/scene_arrays.h"

namespace cellcrush::bench {

std::vector<std::pair<std::string, double>> array_bytes(const Scene& scene, const State& state) {
  std::vector<std::pair<std::string, double>> arrays;
  const auto list_as = [&arrays](const char* whose) {
    return [&arrays, whose](const char* name, const auto& array, const Shape&) {
      arrays.emplace_back(std::string(whose) + name, static_cast<double>(array.capacity() * sizeof(array[0])));
    };
  };
  visit_arrays(scene, list_as("scene."));
  visit_arrays(state, list_as("state."));
  std::sort(arrays.begin(), arrays.end(), [](const auto& one, const auto& other) { return one.second > other.second; });
  return arrays;
}

}  // namespace cellcrush::bench
