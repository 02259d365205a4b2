#include "scene/repeat_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

#include "scene/mesh.h"

namespace cellcrush {
namespace {

/// Copies on either side: more of strips that are narrow, over which walls can lean.
int copies_of(const Scene& scene) {
  constexpr int kMostCopies = 4;
  return std::clamp(static_cast<int>(std::ceil(scene.length / scene.period.length)), 1, kMostCopies);
}

/// The numbers of a mesh and its copies.
struct Copies {
  explicit Copies(const Scene& of_scene)
      : scene(of_scene),
        each_side(copies_of(of_scene)),
        particles(static_cast<int>(of_scene.particle_count())),
        low_of(of_scene.particle_count(), -1) {
    for (std::size_t p = 0; p < scene.period.low.size(); ++p) low_of[scene.period.high[p]] = scene.period.low[p];
  }

  const Scene& scene;
  int each_side;
  int particles;
  std::vector<int> low_of;  ///< of images their joint, otherwise -1

  [[nodiscard]] int count() const { return 2 * each_side + 1; }
  /// `copy` is 0 of the mesh, negative at the low side.
  [[nodiscard]] int particle(int of_mesh, int copy) const {
    const bool is_joined = low_of[of_mesh] >= 0 && copy < each_side;
    return is_joined ? particle(low_of[of_mesh], copy + 1) : (copy + each_side) * particles + of_mesh;
  }
  /// The copies in the order of their elements: the mesh, then from the low side to the high one.
  [[nodiscard]] std::vector<int> in_order_of_elements() const {
    std::vector<int> order = {0};
    for (int copy = -each_side; copy <= each_side; ++copy) {
      if (copy != 0) order.push_back(copy);
    }
    return order;
  }
};

template <class List>
void repeat(List& list, int times) {
  const std::size_t size = list.size();
  list.resize(size * static_cast<std::size_t>(times));
  for (std::size_t i = size; i < list.size(); ++i) list[i] = list[i - size];
}

void repeat_particles(const Copies& copies, Scene& out) {
  const Period& period = copies.scene.period;
  for (std::size_t p = 0; p < period.low.size(); ++p) {
    const int low = period.low[p];
    out.mass[low] += out.mass[period.high[p]];
    out.inverse_mass[low] = 1.0 / out.mass[low];
    for (const int joint : {low, period.high[p]}) {
      out.mass[joint] = out.mass[low];
      out.inverse_mass[joint] = out.inverse_mass[low];
      out.radius[joint] = out.radius[low];
    }
  }
  out.smallest_radius = std::ranges::min(out.radius);
  repeat(out.position, copies.count());
  repeat(out.mass, copies.count());
  repeat(out.inertia, copies.count());
  repeat(out.inverse_mass, copies.count());
  repeat(out.inverse_inertia, copies.count());
  repeat(out.radius, copies.count());
  for (std::size_t i = 0; i < out.position.size(); ++i) {
    const int copy = static_cast<int>(i) / copies.particles - copies.each_side;
    out.position[i][period.axis] += copy * period.length;
  }
  out.first_ball = copies.each_side * copies.particles;
  out.ball_count = copies.particles;
}

void repeat_walls(const Copies& copies, Scene& out) {
  const Scene& scene = copies.scene;
  const Walls& walls = scene.walls;
  out.elements.clear();
  out.walls.blocks.clear();
  out.walls.start.clear();
  out.walls.end.clear();
  int first_wall = 0;
  for (const int copy : copies.in_order_of_elements()) {
    const auto first_element = static_cast<int>(out.elements.size());
    for (const Element& element : scene.elements) {
      Element& added = out.elements.emplace_back(element);
      added.start = copies.particle(element.start, copy);
      added.end = copies.particle(element.end, copy);
    }
    for (WallBlock block : walls.blocks) {
      block.first_wall += first_wall;
      block.first_element += first_element;
      out.walls.blocks.push_back(block);
    }
    for (std::size_t wall = 0; wall < walls.start.size(); ++wall) {
      out.walls.start.push_back(copies.particle(walls.start[wall], copy));
      out.walls.end.push_back(copies.particle(walls.end[wall], copy));
    }
    first_wall += static_cast<int>(walls.start.size());
  }
  repeat(out.walls.thickness, copies.count());
  repeat(out.walls.undeformed_length, copies.count());
  repeat(out.walls.material, copies.count());
  repeat(out.walls.shear, copies.count());
  out.rigid.first_element = static_cast<int>(out.elements.size());
}

}  // namespace

std::shared_ptr<Scene> repeat_mesh(const Scene& scene) {
  const Copies copies(scene);
  auto out = std::make_shared<Scene>(scene);
  out->period = {};
  out->repeated = nullptr;
  repeat_particles(copies, *out);
  repeat_walls(copies, *out);
  out->joint_count = static_cast<int>(out->particle_count());
  link_elements(*out);
  out->bands = {{0, scene.walls.chunk_count(), 0, out->joint_count, out->joint_count, out->joint_count}};
  return out;
}

StartOverlaps overlaps_of_balls(const Scene& repeated, const StartOverlaps& all) {
  StartOverlaps own;
  std::ranges::copy_if(all.pairs, std::back_inserter(own.pairs), [&](const StartOverlap& pair) {
    return pair.ball >= repeated.first_ball && pair.ball < repeated.first_ball + repeated.ball_count;
  });
  if (own.pairs.empty()) return own;
  own.offset.assign(repeated.particle_count() + 1, 0);
  for (const StartOverlap& pair : own.pairs) ++own.offset[pair.ball + 1];
  std::partial_sum(own.offset.begin(), own.offset.end(), own.offset.begin());
  return own;
}

StartOverlaps original_overlaps(const Scene& scene, const StartOverlaps& of_balls) {
  StartOverlaps own = of_balls;
  if (own.pairs.empty()) return own;
  const auto walls = static_cast<int>(scene.walls.start.size());
  const auto elements = static_cast<int>(scene.element_count());
  for (StartOverlap& pair : own.pairs) {
    pair.ball = pair.ball % static_cast<int>(scene.particle_count());
    pair.ball_wall %= walls;
    pair.wall %= walls;
    const int first = pair.first_segment % elements;
    pair.end_segment += first - pair.first_segment;
    pair.first_segment = first;
    pair.nearest %= elements;
  }
  own.offset.assign(scene.particle_count() + 1, 0);
  for (const StartOverlap& pair : own.pairs) ++own.offset[pair.ball + 1];
  std::partial_sum(own.offset.begin(), own.offset.end(), own.offset.begin());
  return own;
}

}  // namespace cellcrush
