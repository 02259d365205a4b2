#include "scene/rigid_links.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "geometry/find_parts.h"
#include "lattice/network.h"
#include "scene/grips.h"

namespace cellcrush {
namespace {

/// A wall that may be a link, between nodes of a list.
struct LinkCandidate {
  int start = 0;
  int end = 0;
  double thickness = 0.0;
  double mass = 0.0;    ///< in any unit, times any depth
  bool is_free = true;  ///< straight, with nothing on it and nothing that holds, moves or pins its ends
};

/// What links are looked for in. Lengths in mm.
struct Candidates {
  std::vector<Vector2> nodes;
  std::vector<LinkCandidate> walls;

  [[nodiscard]] double length(const LinkCandidate& wall) const { return (nodes[wall.end] - nodes[wall.start]).norm(); }
};

/// Walls of which a grip holds an end are no links.
void leave_to_grips(const SceneSpec& spec, Candidates& all) {
  for (const GripLine& line : grip_lines_of(spec, bounds_of(all.nodes))) {
    for (LinkCandidate& wall : all.walls) {
      wall.is_free = wall.is_free && !line.holds(all.nodes[wall.start]) && !line.holds(all.nodes[wall.end]);
    }
  }
}

/// 1 for each node that is held, moved or pinned.
std::vector<char> constrained_nodes(const FrameWalls& frame, const LoadsSpec& loads) {
  std::vector<char> constrained(frame.nodes.size(), 0);
  for (const FrameWalls::Support& support : frame.supports) constrained[support.node] = 1;
  for (const LoadsSpec::NodalMotion& motion : loads.motions) constrained[motion.node] = 1;
  for (const FrameWalls::Beam& beam : frame.beams) {
    if (beam.pin_start) constrained[beam.start] = 1;
    if (beam.pin_end) constrained[beam.end] = 1;
  }
  return constrained;
}

Candidates candidates_of(const SceneSpec& spec, const FrameWalls& frame) {
  Candidates all;
  for (const FrameWalls::Node& node : frame.nodes) all.nodes.emplace_back(node.x_mm, node.y_mm);
  const std::vector<char> constrained = constrained_nodes(frame, spec.loads);
  for (const FrameWalls::Beam& beam : frame.beams) {
    const MaterialSpec& material = beam.material ? *beam.material : spec.material;
    LinkCandidate& wall = all.walls.emplace_back(LinkCandidate{beam.start, beam.end, beam.thickness_mm, 0.0, true});
    wall.mass = *material.density_kg_per_m3 * beam.thickness_mm * all.length(wall);
    wall.is_free = constrained[beam.start] == 0 && constrained[beam.end] == 0;
  }
  for (const LoadsSpec::DistributedLoad& load : spec.loads.distributed_loads) all.walls[load.beam].is_free = false;
  leave_to_grips(spec, all);
  return all;
}

Candidates candidates_of(const SceneSpec& spec, const NetworkWalls& network) {
  const Layout layout = lay_out_network(network);
  Candidates all;
  all.nodes.assign(layout.joints.begin(), layout.joints.end());
  for (const LayoutWall& listed : layout.walls) {
    const MaterialSpec& material = listed.material == 0 ? spec.material : network.materials[listed.material - 1];
    LinkCandidate& wall =
        all.walls.emplace_back(LinkCandidate{listed.start, listed.end, listed.thickness, 0.0, listed.rise == 0.0});
    wall.mass = *material.density_kg_per_m3 * listed.thickness * all.length(wall);
  }
  leave_to_grips(spec, all);
  return all;
}

/// 1 for each wall that is short and free.
std::vector<char> short_walls(const Candidates& all, double slenderness) {
  std::vector<char> is_short;
  is_short.reserve(all.walls.size());
  for (const LinkCandidate& wall : all.walls) {
    is_short.push_back(wall.is_free && all.length(wall) < slenderness * wall.thickness ? 1 : 0);
  }
  return is_short;
}

/// The part that the links connect each node to, as find_parts gives it.
std::vector<int> parts_of(const Candidates& all, const std::vector<char>& is_link) {
  std::vector<LinkCandidate> links;
  for (std::size_t w = 0; w < all.walls.size(); ++w) {
    if (is_link[w] != 0) links.push_back(all.walls[w]);
  }
  return find_parts(all.nodes.size(), links);
}

/// 1 for each link of a part that reaches as far as a link must not be long. `reach` is that length over the thickness.
std::vector<char> links_of_long_parts(const Candidates& all, const std::vector<char>& is_link,
                                      const std::vector<double>& reach) {
  const std::vector<int> part = parts_of(all, is_link);
  struct Box {
    Vector2 low = Vector2::Constant(std::numeric_limits<double>::infinity());
    Vector2 high = Vector2::Constant(-std::numeric_limits<double>::infinity());
    double thickness = 0.0;
  };
  std::vector<Box> boxes(all.nodes.size());
  for (std::size_t w = 0; w < all.walls.size(); ++w) {
    if (is_link[w] == 0) continue;
    Box& box = boxes[part[all.walls[w].start]];
    for (const int node : {all.walls[w].start, all.walls[w].end}) {
      box.low = box.low.cwiseMin(all.nodes[node]);
      box.high = box.high.cwiseMax(all.nodes[node]);
    }
    box.thickness = std::max(box.thickness, all.walls[w].thickness);
  }
  std::vector<char> is_long(all.walls.size(), 0);
  for (std::size_t w = 0; w < all.walls.size(); ++w) {
    const Box& box = boxes[part[all.walls[w].start]];
    is_long[w] = is_link[w] != 0 && (box.high - box.low).norm() >= reach[w] * box.thickness;
  }
  return is_long;
}

/// Splits parts that reach too far: of their links, those remain that are shorter than half of the limit, which is
/// their limit then. A wall that is listed in pieces of one length keeps none.
void split_long_parts(const Candidates& all, double slenderness, std::vector<char>& is_link) {
  std::vector<double> reach(all.walls.size(), slenderness);
  while (true) {
    const std::vector<char> is_long = links_of_long_parts(all, is_link, reach);
    if (std::ranges::count(is_long, 1) == 0) return;
    for (std::size_t w = 0; w < all.walls.size(); ++w) {
      if (is_long[w] == 0) continue;
      reach[w] *= 0.5;
      is_link[w] = all.length(all.walls[w]) < reach[w] * all.walls[w].thickness;
    }
  }
}

/// Mass of the links over that of all walls.
double share_of_links(const Candidates& all, const std::vector<char>& is_link) {
  double mass = 0.0;
  double of_links = 0.0;
  for (std::size_t w = 0; w < all.walls.size(); ++w) {
    mass += all.walls[w].mass;
    if (is_link[w] != 0) of_links += all.walls[w].mass;
  }
  return of_links / mass;
}

std::vector<char> find_links(const Candidates& all, double given_slenderness) {
  for (double slenderness = given_slenderness;; slenderness *= 0.5) {
    std::vector<char> is_link = short_walls(all, slenderness);
    split_long_parts(all, slenderness, is_link);
    if (!(share_of_links(all, is_link) > kMostLinkMass)) return is_link;
  }
}

/// Numbers the nodes of links first, body by body, and their walls last.
ListOrder order_of(const Candidates& all, const std::vector<char>& is_link) {
  const std::vector<int> part = parts_of(all, is_link);
  std::vector<int> body(all.nodes.size(), static_cast<int>(all.nodes.size()));
  for (std::size_t w = 0; w < all.walls.size(); ++w) {
    if (is_link[w] == 0) continue;
    for (const int node : {all.walls[w].start, all.walls[w].end}) body[node] = part[node];
  }
  ListOrder order;
  order.joint.resize(all.nodes.size());
  std::iota(order.joint.begin(), order.joint.end(), 0);
  std::ranges::stable_sort(order.joint, {}, [&](int node) { return body[node]; });
  order.wall.resize(all.walls.size());
  std::iota(order.wall.begin(), order.wall.end(), 0);
  std::ranges::stable_partition(order.wall, [&](int wall) { return is_link[wall] == 0; });
  return order;
}

/// Puts nodes and beams in order, and renames them wherever they are named.
void reorder(const ListOrder& order, FrameWalls& frame, LoadsSpec& loads) {
  const std::vector<int> node = places_of(order.joint);
  const std::vector<int> beam = places_of(order.wall);
  frame.nodes = reordered(frame.nodes, order.joint);
  frame.beams = reordered(frame.beams, order.wall);
  for (FrameWalls::Beam& each : frame.beams) {
    each.start = node[each.start];
    each.end = node[each.end];
  }
  for (int& watched : frame.watched_nodes) watched = node[watched];
  const auto rename = [&node](auto& list) {
    for (auto& each : list) each.node = node[each.node];
  };
  rename(frame.supports);
  rename(loads.loads);
  rename(loads.motions);
  rename(loads.initial_velocities);
  for (LoadsSpec::DistributedLoad& load : loads.distributed_loads) load.beam = beam[load.beam];
}

/// The same of a network. No list of it has only some of the walls.
void reorder(const ListOrder& order, NetworkWalls& network, LoadsSpec& /*loads*/) {
  const std::vector<int> node = places_of(order.joint);
  NetworkWalls given = std::move(network);
  network = {};
  network.wall_thickness_mm = given.wall_thickness_mm;
  network.materials = std::move(given.materials);
  for (const int from : order.joint) {
    network.joints_mm.insert(network.joints_mm.end(), {given.joints_mm[2 * from], given.joints_mm[2 * from + 1]});
  }
  for (const int from : order.wall) {
    network.walls.insert(network.walls.end(), {node[given.walls[2 * from]], node[given.walls[2 * from + 1]]});
  }
  if (!given.thicknesses_mm.empty()) network.thicknesses_mm = reordered(given.thicknesses_mm, order.wall);
  if (!given.rises_mm.empty()) network.rises_mm = reordered(given.rises_mm, order.wall);
  if (!given.wall_materials.empty()) network.wall_materials = reordered(given.wall_materials, order.wall);
}

template <class Listed>
void put_links_first(Listed& listed, LinkedSpec& linked) {
  const Candidates all = candidates_of(linked.spec, listed);
  const std::vector<char> is_link = find_links(all, linked.spec.numerics.rigid_link_slenderness);
  linked.links = static_cast<int>(std::ranges::count(is_link, 1));
  if (linked.links == 0) return;
  linked.order = order_of(all, is_link);
  reorder(linked.order, listed, linked.spec.loads);
}

}  // namespace

LinkedSpec put_rigid_links_first(const SceneSpec& spec) {
  LinkedSpec linked = {spec, {}, 0};
  if (auto* frame = std::get_if<FrameWalls>(&linked.spec.lattice)) put_links_first(*frame, linked);
  if (auto* network = std::get_if<NetworkWalls>(&linked.spec.lattice)) put_links_first(*network, linked);
  return linked;
}

double link_mass_share_of(const Scene& scene) {
  if (scene.rigid.links == 0) return 0.0;
  double mass = 0.0;
  for (std::size_t e = scene.rigid.first_element; e < scene.element_count(); ++e) {
    const Element& link = scene.elements[e];
    mass += scene.materials[link.material].density * scene.depth * link.thickness *
            (scene.position[link.end] - scene.position[link.start]).norm();
  }
  return mass / scene.total_mass;
}

int listed_wall_of(const Scene& scene, int element) {
  if (element >= scene.rigid.first_element) {
    return scene.list_order.listed_wall(static_cast<int>(scene.walls.start.size()) + element -
                                        scene.rigid.first_element);
  }
  const auto after = std::ranges::upper_bound(scene.walls.blocks, element, {}, &WallBlock::first_element);
  const WallBlock& block = *std::prev(after);
  return scene.list_order.listed_wall(block.first_wall + (element - block.first_element) % block.walls);
}

}  // namespace cellcrush
