#include "scene/check_overlap.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "scene/check_spec.h"
#include "scene/initial_overlap.h"

namespace cellcrush {
namespace {

/// Most overlaps that are searched for: enough to see what is wrong.
constexpr std::size_t kMostOverlaps = 20;

std::string thickness_field(const SceneSpec& spec) {
  if (std::holds_alternative<HexagonLattice>(spec.lattice)) {
    return "lattice.hexagon.wall_thickness_mm";
  }
  return std::holds_alternative<SquareLattice>(spec.lattice) ? "lattice.square.wall_thickness_mm"
                                                             : "lattice.triangle.wall_thickness_mm";
}

std::string place_text(const Vector2& place) { return "(" + to_text(place.x()) + ", " + to_text(place.y()) + ") mm"; }

/// The beam of each element.
std::vector<int> beams_of(const FrameLattice& frame, int elements_per_wall) {
  std::vector<int> beam;
  for (std::size_t i = 0; i < frame.beams.size(); ++i) {
    beam.insert(beam.end(), frame.beams[i].elements.value_or(elements_per_wall), static_cast<int>(i));
  }
  return beam;
}

std::string beam_field(int beam) { return "lattice.frame.beams[" + std::to_string(beam) + "]"; }

Problems name_beams(const FrameLattice& frame, int elements_per_wall, const std::vector<InitialOverlap>& overlaps) {
  const std::vector<int> beam = beams_of(frame, elements_per_wall);
  std::set<std::pair<int, int>> named;
  Problems problems;
  for (const InitialOverlap& overlap : overlaps) {
    const auto [one, other] = std::minmax(beam[overlap.first], beam[overlap.second]);
    if (named.emplace(one, other).second) {
      problems.push_back({beam_field(other), "",
                          "overlaps " + beam_field(one) + " before loading, at " + place_text(overlap.place) + ".",
                          "Move their nodes apart, connect the beams at a node, make them thinner, or set "
                          "lattice.frame.self_contact to false."});
    }
  }
  return problems;
}

}  // namespace

Problems check_overlap(const SceneSpec& spec, const Scene& scene) {
  const InitialOverlaps overlaps = find_initial_overlaps(scene, kMostOverlaps);
  const auto* frame = std::get_if<FrameLattice>(&spec.lattice);
  if (overlaps.too_dense && overlaps.found.empty()) {
    return {{frame != nullptr ? "lattice.frame.beams" : thickness_field(spec), "",
             "are too thick or too tangled for contact: each particle has hundreds of elements within reach.",
             "Use thinner walls or longer elements."}};
  }
  if (frame != nullptr) {
    return name_beams(*frame, *spec.elements_per_wall, overlaps.found);
  }
  if (overlaps.found.empty()) {
    return {};
  }
  return {{thickness_field(spec), "",
           "makes walls overlap before loading, first at " + place_text(overlaps.found.front().place) + ".",
           "Use thinner walls or a smaller lattice.imperfection.amplitude_mm."}};
}

}  // namespace cellcrush
