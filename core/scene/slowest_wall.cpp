#include "scene/slowest_wall.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <variant>
#include <vector>

#include "cellcrush/spec_checker.h"
#include "fields/field_checker.h"
#include "lattice/list_walls.h"
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
std::string remedy_for(const SceneSpec& spec, const SlowestWall& slowest) {
  const double slenderness = slowest.length / slowest.thickness;
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

std::string place_of(const SlowestWall& slowest) {
  return "(" + in_digits(slowest.middle.x(), 6) + ", " + in_digits(slowest.middle.y(), 6) + ") mm";
}

}  // namespace

SlowestWall slowest_wall_of(const Scene& scene) {
  const Walls& walls = scene.walls;
  std::vector<double> steps;
  std::size_t slow = 0;
  SlowestWall slowest;
  visit_steps_of_walls(scene, [&](const WallBlock& block, int wall, double, double stable) {
    if (steps.empty() || stable < steps[slow]) {
      slow = steps.size();
      slowest.listed = wall;
      slowest.elements = block.elements;
    }
    steps.push_back(stable);
  });
  if (steps.empty()) return slowest;
  const int wall = std::exchange(slowest.listed, scene.list_order.listed_wall(slowest.listed));
  slowest.length = slowest.elements * walls.undeformed_length[wall];
  slowest.thickness = walls.thickness[wall];
  slowest.middle = 0.5 * (scene.position[walls.start[wall]] + scene.position[walls.end[wall]]);
  const double step = steps[slow];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  slowest.cost = *middle / step;
  return slowest;
}

std::string words_of(const SlowestWall& slowest) {
  return in_digits(slowest.length, 3) + " mm long and " + in_digits(slowest.thickness, 3) + " mm thick, in " +
         std::to_string(slowest.elements) + (slowest.elements == 1 ? " element" : " elements") + ", at " +
         place_of(slowest);
}

std::string times_text(double times) { return in_digits(times, 2); }

Problems note_costly_wall(const SceneSpec& spec, const SlowestWall& slowest, StepBound bound) {
  const bool is_made = has_made_walls(spec);
  const bool is_network = std::holds_alternative<NetworkWalls>(spec.lattice);
  const bool is_listed = is_made || is_network || std::holds_alternative<FrameWalls>(spec.lattice);
  // Walls of regular lattices are nearly of one length.
  if (!is_listed || bound != StepBound::elements || slowest.cost <= kCostlyWall) return {};
  const std::string field = is_made      ? "lattice"
                            : is_network ? "lattice.network.walls"
                                         : "lattice.frame.beams[" + std::to_string(slowest.listed) + "]";
  return {{field, in_digits(slowest.length, 3) + " mm",
           "is the length of a wall at " + place_of(slowest) +
               ", which sets the time step: half of the walls allow one " + times_text(slowest.cost) +
               " times as long, and the run would take as many times fewer steps.",
           remedy_for(spec, slowest)}};
}

Problems find_costly_walls(const SceneSpec& spec, const Scene& scene) {
  return note_costly_wall(spec, slowest_wall_of(scene), scene.schedule.bound);
}

}  // namespace cellcrush
