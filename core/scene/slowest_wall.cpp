#include "scene/slowest_wall.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <variant>
#include <vector>

#include "cellcrush/spec_checker.h"
#include "fields/field_checker.h"
#include "scene/rigid_links.h"
#include "scene/time_step.h"

namespace cellcrush {
namespace {

std::string in_digits(double value, int digits) {
  std::array<char, 32> buffer{};
  char* const begin = buffer.data();
  const auto end = std::to_chars(begin, begin + buffer.size(), value, std::chars_format::general, digits).ptr;
  double rounded = value;
  std::from_chars(begin, end, rounded);
  return to_text(rounded);
}

/// What to do about a wall that costs many steps.
std::string remedy_for(const SceneSpec& spec, const Scene& scene, const SlowestWall& slowest) {
  const double slenderness = slowest.length / scene.walls.thickness[slowest.wall];
  if (slenderness >= FieldChecker::greatest_of("numerics.rigid_link_slenderness")) {
    return "Give the wall fewer elements, or merge its ends.";
  }
  if (slenderness >= spec.numerics.rigid_link_slenderness) {
    return "Make such walls rigid links by a numerics.rigid_link_slenderness above " + in_digits(slenderness, 3) +
           ", give them fewer elements, or merge their ends.";
  }
  return "Merge its ends. It is no rigid link, because it is an arc, its ends are held, moved or pinned, it carries a "
         "distributed load, short walls that are joined to it reach too far, or all of them have more than " +
         to_text(100.0 * kMostLinkMass) + " % of the mass.";
}

/// The middle of a wall.
std::string place_of(const Scene& scene, const SlowestWall& slowest) {
  const Walls& walls = scene.walls;
  const Vector2 middle = 0.5 * (scene.position[walls.start[slowest.wall]] + scene.position[walls.end[slowest.wall]]);
  return "(" + in_digits(middle.x(), 6) + ", " + in_digits(middle.y(), 6) + ") mm";
}

}  // namespace

SlowestWall slowest_wall_of(const Scene& scene) {
  std::vector<double> steps;
  SlowestWall slowest;
  visit_steps_of_walls(scene, [&](const WallBlock& block, int wall, double, double stable) {
    if (steps.empty() || stable < steps[slowest.wall]) {
      slowest = {wall, block.elements, block.elements * scene.walls.undeformed_length[wall]};
    }
    steps.push_back(stable);
  });
  if (!steps.empty()) {
    const double step = steps[slowest.wall];
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    slowest.cost = *middle / step;
  }
  return slowest;
}

std::string words_of(const Scene& scene, const SlowestWall& slowest) {
  const Walls& walls = scene.walls;
  return in_digits(slowest.length, 3) + " mm long and " + in_digits(walls.thickness[slowest.wall], 3) +
         " mm thick, in " + std::to_string(slowest.elements) + (slowest.elements == 1 ? " element" : " elements") +
         ", at " + place_of(scene, slowest);
}

std::string times_text(double times) { return in_digits(times, 2); }

Problems find_costly_walls(const SceneSpec& spec, const Scene& scene) {
  const bool is_network = std::holds_alternative<NetworkWalls>(spec.lattice);
  if ((!is_network && !std::holds_alternative<FrameWalls>(spec.lattice)) ||
      scene.schedule.bound != StepBound::elements) {
    return {};  // walls of regular lattices are nearly of one length
  }
  const SlowestWall slowest = slowest_wall_of(scene);
  if (slowest.cost <= kCostlyWall) {
    return {};
  }
  return {{is_network ? "lattice.network.walls"
                      : "lattice.frame.beams[" + std::to_string(scene.frame_order.beam_of(slowest.wall)) + "]",
           in_digits(slowest.length, 3) + " mm",
           "is the length of a wall at " + place_of(scene, slowest) +
               ", which sets the time step: half of the walls allow one " + times_text(slowest.cost) +
               " times as long, and the run would take as many times fewer steps.",
           remedy_for(spec, scene, slowest)}};
}

}  // namespace cellcrush
