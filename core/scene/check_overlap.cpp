#include "scene/check_overlap.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contact/topology/initial_overlap.h"
#include "lattice/lattice.h"
#include "scene/check_spec.h"

namespace cellcrush {
namespace {

std::string place_text(const Vector2& place) { return "(" + to_text(place.x()) + ", " + to_text(place.y()) + ") mm"; }

std::string field_of_beam(int beam) { return "lattice.frame.beams[" + std::to_string(beam) + "]"; }

Problems name_beams(const FrameWalls& frame, int elements_per_wall, const std::vector<InitialOverlap>& overlaps) {
  std::vector<int> beam;  // of each element
  for (std::size_t i = 0; i < frame.beams.size(); ++i) {
    beam.insert(beam.end(), frame.beams[i].elements.value_or(elements_per_wall), static_cast<int>(i));
  }
  std::set<std::pair<int, int>> named;
  Problems problems;
  for (const InitialOverlap& overlap : overlaps) {
    const auto [one, other] = std::minmax(beam[overlap.first], beam[overlap.second]);
    if (named.emplace(one, other).second) {
      problems.push_back({field_of_beam(other), "",
                          "overlaps " + field_of_beam(one) + " before loading, at " + place_text(overlap.place) + ".",
                          "Move their nodes apart, connect the beams at a node, make them thinner, or set "
                          "lattice.frame.self_contact to false."});
    }
  }
  return problems;
}

}  // namespace

Problems check_overlap(const SceneSpec& spec, const Scene& scene) {
  constexpr std::size_t kMostOverlaps = 20;  // enough to see what is wrong
  const InitialOverlaps overlaps = find_initial_overlaps(scene, kMostOverlaps);
  const auto* frame = std::get_if<FrameWalls>(&spec.lattice);
  const std::string field = frame != nullptr ? "lattice.frame.beams" : path_of_lattice(spec) + "wall_thickness_mm";
  if (overlaps.too_dense && overlaps.found.empty()) {
    return {{field, "",
             "are too thick or too tangled for contact: each particle has hundreds of elements within reach.",
             "Use thinner walls or longer elements."}};
  }
  if (frame != nullptr) {
    return name_beams(*frame, *spec.elements_per_wall, overlaps.found);
  }
  if (overlaps.found.empty()) {
    return {};
  }
  return {{field, "", "makes walls overlap before loading, first at " + place_text(overlaps.found.front().place) + ".",
           "Use thinner walls, or a smaller lattice.imperfection.amplitude_mm or bow_mm."}};
}

}  // namespace cellcrush
