#include "scene/rigid_links.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "geometry/find_parts.h"

namespace cellcrush {
namespace {

double listed_length(const FrameWalls& frame, const FrameWalls::Beam& beam) {
  const FrameWalls::Node& start = frame.nodes[beam.start];
  const FrameWalls::Node& end = frame.nodes[beam.end];
  return std::hypot(end.x_mm - start.x_mm, end.y_mm - start.y_mm);
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

/// 1 for each beam that is short and free.
std::vector<char> short_beams(const FrameWalls& frame, const LoadsSpec& loads, double slenderness) {
  const std::vector<char> constrained = constrained_nodes(frame, loads);
  std::vector<char> is_short(frame.beams.size(), 0);
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    const FrameWalls::Beam& beam = frame.beams[b];
    is_short[b] = listed_length(frame, beam) < slenderness * beam.thickness_mm && constrained[beam.start] == 0 &&
                  constrained[beam.end] == 0;
  }
  for (const LoadsSpec::DistributedLoad& load : loads.distributed_loads) is_short[load.beam] = 0;
  return is_short;
}

/// The part that the links connect each node to, as find_parts gives it.
std::vector<int> parts_of(const FrameWalls& frame, const std::vector<char>& is_link) {
  std::vector<FrameWalls::Beam> links;
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    if (is_link[b] != 0) links.push_back(frame.beams[b]);
  }
  return find_parts(frame.nodes.size(), links);
}

/// 1 for each link of a part that reaches as far as a link must not be long. `reach` is that length over the thickness.
std::vector<char> links_of_long_parts(const FrameWalls& frame, const std::vector<char>& is_link,
                                      const std::vector<double>& reach) {
  const std::vector<int> part = parts_of(frame, is_link);
  struct Box {
    Vector2 low = Vector2::Constant(std::numeric_limits<double>::infinity());
    Vector2 high = Vector2::Constant(-std::numeric_limits<double>::infinity());
    double thickness = 0.0;
  };
  std::vector<Box> boxes(frame.nodes.size());
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    if (is_link[b] == 0) continue;
    Box& box = boxes[part[frame.beams[b].start]];
    for (const int node : {frame.beams[b].start, frame.beams[b].end}) {
      const Vector2 place(frame.nodes[node].x_mm, frame.nodes[node].y_mm);
      box.low = box.low.cwiseMin(place);
      box.high = box.high.cwiseMax(place);
    }
    box.thickness = std::max(box.thickness, frame.beams[b].thickness_mm);
  }
  std::vector<char> is_long(frame.beams.size(), 0);
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    const Box& box = boxes[part[frame.beams[b].start]];
    is_long[b] = is_link[b] != 0 && (box.high - box.low).norm() >= reach[b] * box.thickness;
  }
  return is_long;
}

/// Splits parts that reach too far: of their links, those remain that are shorter than half of the limit, which is
/// their limit then. A wall that is listed in pieces of one length keeps none.
void split_long_parts(const FrameWalls& frame, double slenderness, std::vector<char>& is_link) {
  std::vector<double> reach(frame.beams.size(), slenderness);
  while (true) {
    const std::vector<char> is_long = links_of_long_parts(frame, is_link, reach);
    if (std::ranges::count(is_long, 1) == 0) return;
    for (std::size_t b = 0; b < frame.beams.size(); ++b) {
      if (is_long[b] == 0) continue;
      reach[b] *= 0.5;
      is_link[b] = listed_length(frame, frame.beams[b]) < reach[b] * frame.beams[b].thickness_mm;
    }
  }
}

/// Mass of the links over that of all beams.
double share_of_links(const SceneSpec& spec, const FrameWalls& frame, const std::vector<char>& is_link) {
  double all = 0.0;
  double of_links = 0.0;
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    const FrameWalls::Beam& beam = frame.beams[b];
    const MaterialSpec& material = beam.material ? *beam.material : spec.material;
    const double mass = *material.density_kg_per_m3 * beam.thickness_mm * listed_length(frame, beam);
    all += mass;
    if (is_link[b] != 0) of_links += mass;
  }
  return of_links / all;
}

std::vector<char> find_links(const SceneSpec& spec, const FrameWalls& frame) {
  for (double slenderness = spec.numerics.rigid_link_slenderness;; slenderness *= 0.5) {
    std::vector<char> is_link = short_beams(frame, spec.loads, slenderness);
    split_long_parts(frame, slenderness, is_link);
    if (share_of_links(spec, frame, is_link) <= kMostLinkMass) return is_link;
  }
}

/// Numbers the nodes of links first, body by body.
std::vector<int> order_of_nodes(const FrameWalls& frame, const std::vector<char>& is_link) {
  const std::vector<int> part = parts_of(frame, is_link);
  std::vector<int> body(frame.nodes.size(), static_cast<int>(frame.nodes.size()));
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    if (is_link[b] == 0) continue;
    for (const int node : {frame.beams[b].start, frame.beams[b].end}) body[node] = part[node];
  }
  std::vector<int> order(frame.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int node) { return body[node]; });
  return order;
}

/// The items of a list in another order.
template <class Item>
std::vector<Item> reordered(const std::vector<Item>& items, const std::vector<int>& order) {
  std::vector<Item> result;
  result.reserve(items.size());
  for (const int from : order) result.push_back(items[from]);
  return result;
}

std::vector<int> places_of(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  return place;
}

/// Puts nodes and beams in order, and renames them wherever they are named.
void reorder(const FrameOrder& order, FrameWalls& frame, LoadsSpec& loads) {
  const std::vector<int> node = places_of(order.node);
  const std::vector<int> beam = places_of(order.beam);
  frame.nodes = reordered(frame.nodes, order.node);
  frame.beams = reordered(frame.beams, order.beam);
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

}  // namespace

LinkedFrame put_rigid_links_first(const SceneSpec& spec) {
  LinkedFrame linked = {spec, {}, 0};
  auto* frame = std::get_if<FrameWalls>(&linked.spec.lattice);
  if (frame == nullptr) return linked;
  const std::vector<char> is_link = find_links(spec, *frame);
  linked.links = static_cast<int>(std::ranges::count(is_link, 1));
  if (linked.links == 0) return linked;
  linked.order.node = order_of_nodes(*frame, is_link);
  linked.order.beam.resize(frame->beams.size());
  std::iota(linked.order.beam.begin(), linked.order.beam.end(), 0);
  std::ranges::stable_partition(linked.order.beam, [&](int beam) { return is_link[beam] == 0; });
  reorder(linked.order, *frame, linked.spec.loads);
  return linked;
}

double link_mass_share_of(const Scene& scene) {
  if (scene.frame_order.beam.empty()) return 0.0;
  double mass = 0.0;
  for (std::size_t e = scene.rigid.first_element; e < scene.element_count(); ++e) {
    const Element& link = scene.elements[e];
    mass += scene.materials[link.material].density * scene.depth * link.thickness *
            (scene.position[link.end] - scene.position[link.start]).norm();
  }
  return mass / scene.total_mass;
}

int beam_of_element(const Scene& scene, int element) {
  if (element >= scene.rigid.first_element) {
    return scene.frame_order.beam_of(static_cast<int>(scene.walls.start.size()) + element - scene.rigid.first_element);
  }
  const auto after = std::ranges::upper_bound(scene.walls.blocks, element, {}, &WallBlock::first_element);
  const WallBlock& block = *std::prev(after);
  return scene.frame_order.beam_of(block.first_wall + (element - block.first_element) % block.walls);
}

}  // namespace cellcrush
