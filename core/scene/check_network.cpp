#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/vector.h"
#include "scene/check_spec.h"

namespace cellcrush {
namespace {

const std::string kNetworkPath = "lattice.network.";

/// Whether a wall's joints exist. All that follows asks for them.
bool has_joints_of_wall(const NetworkWalls& network, std::size_t wall) {
  const auto exists = [&](int joint) { return joint >= 0 && joint < static_cast<int>(network.joint_count()); };
  return exists(network.walls[2 * wall]) && exists(network.walls[2 * wall + 1]);
}

double chord_of(const NetworkWalls& network, std::size_t wall) {
  const auto place = [&](int joint) { return Vector2(network.joints_mm[2 * joint], network.joints_mm[2 * joint + 1]); };
  return (place(network.walls[2 * wall + 1]) - place(network.walls[2 * wall])).norm();
}

/// Names entries of a list that are wrong, and at most so many of a kind.
class NetworkProblems {
 public:
  NetworkProblems(FieldChecker& check, std::string list, std::string message, std::string remedy)
      : check_(check), list_(std::move(list)), message_(std::move(message)), remedy_(std::move(remedy)) {}

  void add(std::size_t index, const std::string& value) {
    constexpr int kMost = 10;
    if (++count_ <= kMost) {
      check_.add(kNetworkPath + list_ + "[" + std::to_string(index) + "]", value, message_, remedy_);
    }
  }

 private:
  FieldChecker& check_;
  std::string list_;
  std::string message_;
  std::string remedy_;
  int count_ = 0;
};

/// A list has an entry for each wall, or none.
void check_list_size(const std::string& list, std::size_t size, std::size_t walls, FieldChecker& check) {
  if (size == 0 || size == walls) return;
  check.add(kNetworkPath + list, std::to_string(size) + " entries", "do not fit " + std::to_string(walls) + " walls.",
            "Give one entry for each wall, or leave the list out.");
}

void check_network_joints(const NetworkWalls& network, FieldChecker& check) {
  constexpr double kFarthest = 1e9;
  if (network.joints_mm.size() % 2 != 0 || network.joints_mm.size() < 4) {
    check.add(kNetworkPath + "joints_mm", std::to_string(network.joints_mm.size()) + " numbers",
              "are not the x and y of two or more joints.", "Give x and y of each joint, one joint after another.");
  }
  NetworkProblems far(check, "joints_mm", "is not a place within 1e9 mm.", "Give a finite number of mm.");
  for (std::size_t i = 0; i < network.joints_mm.size(); ++i) {
    if (!(std::abs(network.joints_mm[i]) <= kFarthest)) far.add(i, to_text(network.joints_mm[i]));
  }
}

void check_network_walls(const NetworkWalls& network, FieldChecker& check) {
  if (network.walls.size() % 2 != 0 || network.walls.empty()) {
    check.add(kNetworkPath + "walls", std::to_string(network.walls.size()) + " numbers",
              "are not the start and the end of one or more walls.", "Give two joints for each wall.");
  }
  NetworkProblems unknown(check, "walls", "is not a joint of the network: joints are counted from 0.",
                          "Give an index of at most " + std::to_string(network.joint_count() - 1) + ".");
  NetworkProblems short_walls(check, "walls", "gives the wall no length.", "Connect two joints at different places.");
  NetworkProblems twice(check, "walls", "begins a wall that is there already.", "Remove it, or make it thicker.");
  NetworkProblems alone(check, "joints_mm", "is of a joint without walls.", "Connect the joint, or remove it.");
  std::vector<bool> joined(network.joint_count(), false);
  std::map<std::pair<std::pair<int, int>, double>, std::size_t> seen;
  for (std::size_t wall = 0; wall < network.wall_count(); ++wall) {
    const int start = network.walls[2 * wall];
    const int end = network.walls[2 * wall + 1];
    if (!has_joints_of_wall(network, wall)) {
      const bool is_start = start < 0 || start >= static_cast<int>(network.joint_count());
      unknown.add(2 * wall + (is_start ? 0 : 1), std::to_string(is_start ? start : end));
      continue;
    }
    joined[start] = joined[end] = true;
    if (chord_of(network, wall) == 0.0) short_walls.add(2 * wall, std::to_string(start));
    const double rise = wall < network.rises_mm.size() ? network.rises_mm[wall] : 0.0;
    const double seen_from_lower = start < end ? rise : -rise;
    const std::pair<int, int> ends = std::minmax(start, end);
    if (!seen.emplace(std::pair(ends, seen_from_lower), wall).second) twice.add(2 * wall, std::to_string(start));
  }
  for (std::size_t joint = 0; joint < joined.size(); ++joint) {
    if (!joined[joint]) alone.add(2 * joint, to_text(network.joints_mm[2 * joint]));
  }
}

void check_network_thicknesses(const NetworkWalls& network, FieldChecker& check) {
  const std::string field = kNetworkPath + "wall_thickness_mm";
  check_list_size("thicknesses_mm", network.thicknesses_mm.size(), network.wall_count(), check);
  if (network.thicknesses_mm.empty() || network.wall_thickness_mm) {
    check.within_limits(field, network.wall_thickness_mm, " (or one for each wall in thicknesses_mm)");
  }
  NetworkProblems wrong(check, "thicknesses_mm", "is not a thickness.", "Give 1e-6 to 1e12 mm.");
  for (std::size_t wall = 0; wall < network.thicknesses_mm.size(); ++wall) {
    const double thickness = network.thicknesses_mm[wall];
    if (!(thickness >= 1e-6 && thickness <= 1e12)) wrong.add(wall, to_text(thickness));
  }
}

void check_network_rises(const NetworkWalls& network, FieldChecker& check) {
  check_list_size("rises_mm", network.rises_mm.size(), network.wall_count(), check);
  NetworkProblems high(check, "rises_mm", "is more than the length of the wall's chord.",
                       "Divide the arc into two walls.");
  for (std::size_t wall = 0; wall < std::min(network.rises_mm.size(), network.wall_count()); ++wall) {
    if (has_joints_of_wall(network, wall) && !(std::abs(network.rises_mm[wall]) <= chord_of(network, wall))) {
      high.add(wall, to_text(network.rises_mm[wall]));
    }
  }
}

void check_network_materials(const NetworkWalls& network, FieldChecker& check) {
  for (std::size_t i = 0; i < network.materials.size(); ++i) {
    check_material(kNetworkPath + "materials[" + std::to_string(i) + "].", network.materials[i], check);
  }
  check_list_size("wall_materials", network.wall_materials.size(), network.wall_count(), check);
  NetworkProblems unknown(check, "wall_materials", "is none of the materials.",
                          "Give 0 for the material of the case, or 1 to " + std::to_string(network.materials.size()) +
                              " for one of lattice.network.materials.");
  for (std::size_t wall = 0; wall < network.wall_materials.size(); ++wall) {
    const int material = network.wall_materials[wall];
    if (material < 0 || material > static_cast<int>(network.materials.size())) {
      unknown.add(wall, std::to_string(material));
    }
  }
}

}  // namespace

void check_network(const SceneSpec& spec, FieldChecker& check) {
  const NetworkWalls& network = std::get<NetworkWalls>(spec.lattice);
  check_network_joints(network, check);
  check_network_walls(network, check);
  check_network_thicknesses(network, check);
  check_network_rises(network, check);
  check_network_materials(network, check);
  if (const double elements = count_elements(spec); elements > kMostElements) {
    check.add(kNetworkPath + "walls", std::to_string(network.wall_count()) + " walls",
              "make " + to_text(elements) + " elements with the elements_per_wall given.",
              "Keep walls x elements_per_wall at or below " + to_text(kMostElements) + ".");
  }
}

double shortest_wall_of(const NetworkWalls& network) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t wall = 0; wall < network.wall_count(); ++wall) {
    if (has_joints_of_wall(network, wall)) shortest = std::min(shortest, chord_of(network, wall));
  }
  return shortest > 0.0 ? shortest : std::numeric_limits<double>::infinity();
}

}  // namespace cellcrush
