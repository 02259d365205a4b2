#include "translate/network_lists.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "cellcrush/v1/field.pb.h"

namespace cellcrush::translate {
namespace {

const std::string kNetwork = "lattice.network.";

/// A list and its name in the compact form.
constexpr std::pair<const char*, const char*> kLists[] = {{"joints_mm", "compact.joint_differences"},
                                                          {"walls", "compact.wall_differences"},
                                                          {"thicknesses_mm", "compact.thicknesses"},
                                                          {"rises_mm", "compact.rises"}};

void expand(const v1::Lattice::Network::Compact& in, NetworkWalls& out) {
  // Divided, not multiplied by a fraction: a number of few decimals then comes out as it was.
  const double steps = std::max(1, in.steps_per_mm());
  std::int64_t place[2] = {};
  out.joints_mm.reserve(in.joint_differences_size());
  for (int i = 0; i < in.joint_differences_size(); ++i) {
    std::int64_t& coordinate = place[i % 2];
    coordinate += in.joint_differences(i);
    out.joints_mm.push_back(static_cast<double>(coordinate) / steps);
  }
  std::int64_t joint = 0;
  out.walls.reserve(in.wall_differences_size());
  for (const int difference : in.wall_differences()) {
    joint += difference;
    const bool is_number = joint >= 0 && joint <= std::numeric_limits<int>::max();
    out.walls.push_back(is_number ? static_cast<int>(joint) : -1);
  }
  for (const int thickness : in.thicknesses()) out.thicknesses_mm.push_back(thickness / steps);
  for (const int rise : in.rises()) out.rises_mm.push_back(rise / steps);
}

}  // namespace

NetworkWalls lists_of(const v1::Lattice::Network& network) {
  NetworkWalls out;
  if (network.has_wall_thickness_mm()) out.wall_thickness_mm = network.wall_thickness_mm();
  out.wall_materials.assign(network.wall_materials().begin(), network.wall_materials().end());
  if (network.has_compact()) {
    expand(network.compact(), out);
    return out;
  }
  out.joints_mm.assign(network.joints_mm().begin(), network.joints_mm().end());
  out.walls.assign(network.walls().begin(), network.walls().end());
  out.thicknesses_mm.assign(network.thicknesses_mm().begin(), network.thicknesses_mm().end());
  out.rises_mm.assign(network.rises_mm().begin(), network.rises_mm().end());
  return out;
}

void check_compact(const v1::Lattice::Network& network, Problems& problems) {
  if (!network.has_compact()) return;
  const int steps = network.compact().steps_per_mm();
  const v1::FieldRules& rules =
      v1::Lattice::Network::Compact::descriptor()->FindFieldByName("steps_per_mm")->options().GetExtension(v1::rules);
  if (steps < rules.minimum() || steps > rules.maximum()) {
    problems.push_back(
        {kNetwork + "compact.steps_per_mm", std::to_string(steps),
         network.compact().has_steps_per_mm() ? "is out of range." : "is missing.",
         "Give a number from 1 to " + std::to_string(std::lround(rules.maximum())) + ", such as 1000000."});
  }
  const bool is_given[] = {!network.joints_mm().empty(), !network.walls().empty(), !network.thicknesses_mm().empty(),
                           !network.rises_mm().empty()};
  for (int i = 0; i < 4; ++i) {
    if (!is_given[i]) continue;
    problems.push_back({kNetwork + "compact", "",
                        "replaces " + kNetwork + kLists[i].first + ", which is given beside it.",
                        "Remove one of the two."});
  }
}

void name_compact(const v1::Lattice::Network& network, Problems& problems) {
  if (!network.has_compact()) return;
  for (Problem& problem : problems) {
    for (const auto& [list, compact] : kLists) {
      const std::string path = kNetwork + list;
      const std::size_t end = path.size();
      if (problem.field.starts_with(path) && (problem.field.size() == end || problem.field[end] == '['))
        problem.field.replace(0, end, kNetwork + compact);
    }
  }
}

}  // namespace cellcrush::translate
