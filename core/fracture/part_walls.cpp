#include "fracture/part_walls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/topology/bands.h"
#include "contact/topology/wall_paths.h"
#include "scene/mesh.h"

namespace cellcrush {
namespace {

const WallBlock& block_of(const Walls& walls, int wall) {
  return *std::prev(std::ranges::upper_bound(walls.blocks, wall, {}, &WallBlock::first_wall));
}

/// The element at an end of a wall.
int element_at(const Walls& walls, const FailedEnd& end) {
  const WallBlock& block = block_of(walls, end.wall);
  return block.first_element + (end.at_end ? block.elements - 1 : 0) * block.walls + end.wall - block.first_wall;
}

int& joint_at(Walls& walls, const FailedEnd& end) { return (end.at_end ? walls.end : walls.start)[end.wall]; }
int joint_at(const Walls& walls, const FailedEnd& end) { return (end.at_end ? walls.end : walls.start)[end.wall]; }

EndShare share_of(const Scene& scene, const FailedEnd& end) {
  return share_of_end(scene, end.wall, block_of(scene.walls, end.wall), end.at_end);
}

/// Number in outputs of a joint of a scene after some breaks (Break).
int output_joint(const Scene& scene, std::size_t breaks, int joint) {
  const int added = joint - (scene.joint_count - static_cast<int>(breaks));
  return added < 0 ? joint : static_cast<int>(scene.particle_count() - breaks) + added;
}

/// Whether a joint keeps its place, or moves as imposed, whatever is left of it.
bool is_held(const Scene& scene, int joint) {
  const bool supported = !scene.supports.empty() && scene.supports[joint].x.held && scene.supports[joint].y.held;
  return supported || joint < scene.rigid.particle_count();
}

/// Makes room behind the joints, for as many new ones as there are ends. An empty list stays empty.
template <class List, class ValueOf>
void insert_joints(const Scene& before, std::span<const FailedEnd> ends, List& list, const ValueOf& value_of) {
  if (list.empty()) return;
  List added;
  for (const FailedEnd& end : ends) added.push_back(value_of(joint_at(before.walls, end)));
  list.insert(list.begin() + before.joint_count, added.begin(), added.end());
}

void insert_into_scene(const Scene& before, std::span<const FailedEnd> ends, Scene& scene) {
  const auto insert = [&](auto& list, const auto& value_of) { insert_joints(before, ends, list, value_of); };
  insert(scene.position, [&](int joint) { return before.position[joint]; });
  insert(scene.radius, [](int) { return 0.0; });
  for (std::vector<double>* list : {&scene.mass, &scene.inertia}) insert(*list, [](int) { return 0.0; });
  for (LaneVector<double>* list : {&scene.inverse_mass, &scene.inverse_inertia}) insert(*list, [](int) { return 0.0; });
  insert(scene.supports, [](int) { return Support(); });
  insert(scene.initial_velocity, [&](int joint) { return before.initial_velocity[joint]; });
  insert(scene.initial_spin, [&](int joint) { return before.initial_spin[joint]; });
  if (!scene.list_order.joint.empty()) {
    insert(scene.list_order.joint, [&](int joint) { return before.list_order.joint[joint]; });
  }
  const auto more = static_cast<int>(ends.size());
  const auto shift = [&](int& particle) { particle += particle >= before.joint_count ? more : 0; };
  for (Element& element : scene.elements) {
    shift(element.start);
    shift(element.end);
  }
  for (WallBlock& block : scene.walls.blocks) block.first_inner += more;
  for (int& particle : scene.gripped) shift(particle);
  scene.joint_count += more;
}

/// Joints that share their mass with one, itself among them: those of its pin (E16).
std::vector<int> joints_with(const Scene& scene, int joint) {
  for (std::size_t pin = 0; pin < scene.pins.count(); ++pin) {
    const std::span<const int> joints = scene.pins.joints_of(pin);
    if (std::ranges::find(joints, joint) != joints.end()) return {joints.begin(), joints.end()};
  }
  return {joint};
}

void put_mass(int joint, double mass, double inertia, Scene& scene) {
  scene.mass[joint] = mass;
  scene.inertia[joint] = inertia;
  scene.inverse_mass[joint] = mass > 0.0 ? 1.0 / mass : 0.0;
  scene.inverse_inertia[joint] = inertia > 0.0 ? 1.0 / inertia : 0.0;
}

/// Moves the share of each end from its joint to the new one. A held joint that nothing is left of keeps as much as
/// rounding makes: its reaction follows from its mass.
void divide_masses(const Scene& before, std::span<const FailedEnd> ends, Scene& scene) {
  constexpr double kRounding = 1e-12;  // over the share
  const auto less = [](double all, double share, double least) {
    return all - share > kRounding * share ? all - share : least * share;
  };
  int added = before.joint_count;
  for (const FailedEnd& end : ends) {
    const int from = joint_at(before.walls, end);
    const EndShare share = share_of(before, end);
    const std::vector<int> together = joints_with(scene, from);
    for (const int joint : together) {
      put_mass(joint, less(scene.mass[joint], share.mass / static_cast<double>(together.size()), kRounding),
               joint == from ? less(scene.inertia[joint], share.inertia, 0.0) : scene.inertia[joint], scene);
    }
    put_mass(added++, share.mass, share.inertia, scene);
  }
}

double radius_at(const Scene& scene, int joint) {
  double radius = 0.0;
  for (int k = scene.incidence_offset[joint]; k < scene.incidence_offset[joint + 1]; ++k) {
    radius = std::max(radius, 0.5 * scene.elements[scene.incidence[k]].thickness);
  }
  return radius;
}

/// Gives the part of a chain from an end on a number of its own.
void renumber_chain(const FailedEnd& end, Scene& scene) {
  const int first = element_at(scene.walls, end);
  const int old = scene.chain[first];
  const int renewed = 1 + std::ranges::max(scene.chain);
  std::vector<int> next = {first};
  while (!next.empty()) {
    const int element = next.back();
    next.pop_back();
    if (scene.chain[element] != old) continue;
    scene.chain[element] = renewed;
    for (const int node : {scene.elements[element].start, scene.elements[element].end}) {
      for (int k = scene.incidence_offset[node]; k < scene.incidence_offset[node + 1]; ++k) {
        next.push_back(scene.incidence[k]);
      }
    }
  }
}

}  // namespace

bool can_part(const Scene& scene, std::span<const FailedEnd> others, const FailedEnd& end) {
  const int joint = joint_at(scene.walls, end);
  const double share = share_of(scene, end).mass;
  int walls = scene.incidence_offset[joint + 1] - scene.incidence_offset[joint] - 1;
  double mass = scene.mass[joint] - share;
  for (const FailedEnd& other : others) {
    if (joint_at(scene.walls, other) != joint) continue;
    --walls;
    mass -= share_of(scene, other).mass;
  }
  constexpr double kAttached = 1e-6;  // over the share
  return walls > 0 || mass > kAttached * share || is_held(scene, joint);
}

std::shared_ptr<Scene> part_mesh(const Scene& before, std::span<const FailedEnd> ends) {
  auto scene = std::make_shared<Scene>(before);
  insert_into_scene(before, ends, *scene);
  int joint = before.joint_count;
  for (const FailedEnd& end : ends) {
    Element& element = scene->elements[element_at(scene->walls, end)];
    (end.at_end ? element.end : element.start) = joint;
    joint_at(scene->walls, end) = joint++;
  }
  divide_masses(before, ends, *scene);
  if (scene->rigid.count() > 0) lump_rigid_bodies(*scene);
  order_joints(scene->walls, scene->joint_count);
  link_elements(*scene);
  for (const FailedEnd& end : ends) {
    scene->radius[joint_at(scene->walls, end)] = radius_at(*scene, joint_at(scene->walls, end));
    scene->radius[joint_at(before.walls, end)] = radius_at(*scene, joint_at(before.walls, end));
    renumber_chain(end, *scene);
  }
  scene->smallest_radius = std::ranges::min(scene->radius);
  scene->bands = {whole_band(*scene)};
  if (scene->contact.present) scene->limited_reaches = find_limited_reaches(*scene);
  return scene;
}

void note_breaks(const Scene& before, std::span<const FailedEnd> ends, State& state) {
  const std::size_t earlier = state.breaks.size();
  for (const FailedEnd& end : ends) {
    const int joint = joint_at(before.walls, end);
    Break broken;
    broken.step = state.step;
    broken.time = state.time;
    broken.place = state.position[joint];
    broken.plastic = end.energy;
    broken.element = element_at(before.walls, end);
    broken.at_end = end.at_end ? 1 : 0;
    broken.wall = before.list_order.listed_wall(end.wall);
    broken.particle = output_joint(before, earlier, joint);
    state.breaks.push_back(broken);
  }
}

void part_state(const Scene& before, const Scene& after, std::span<const FailedEnd> ends, State& state) {
  const auto copy = [&](auto& list) { insert_joints(before, ends, list, [&list](int joint) { return list[joint]; }); };
  const auto clear = [&](auto& list, const auto& zero) {
    if (!list.empty()) list.assign(after.particle_count(), zero);
  };
  copy(state.position);
  copy(state.velocity);
  copy(state.rotation);
  copy(state.spin);
  copy(state.radius_growth);
  insert_joints(before, ends, state.reaction_impulse, [](int) { return ReactionImpulse(); });
  for (const FailedEnd& end : ends) {
    for (const int joint : {joint_at(before.walls, end), joint_at(after.walls, end)}) {
      if (after.inertia[joint] == 0.0) state.spin[joint] = 0.0;
    }
  }
  for (std::size_t body = 0; body < after.rigid.count(); ++body) {
    const Vector2 apart = after.rigid.centre[body] - before.rigid.centre[body];
    const double angle = state.rigid_rotation[body];
    const Vector2 moved = std::cos(angle) * apart + std::sin(angle) * normal_of(apart);
    state.rigid_centre[body] += moved;
    state.rigid_velocity[body] += state.rigid_spin[body] * normal_of(moved);
  }
  copy(state.internal_force);
  copy(state.internal_moment);
  clear(state.load_force, Vector2(0.0, 0.0));
  clear(state.load_moment, 0.0);
  clear(state.contact_force, ContactForce());
  clear(state.contact_moment, 0.0);
  clear(state.friction_force, Vector2(0.0, 0.0));
  const std::size_t more = ends.size();
  const auto widen = [&](std::vector<double>& list) { insert_joints(before, ends, list, [](int) { return 0.0; }); };
  widen(state.impact_friction);
  widen(state.support_friction);
  if (!state.rigid_wall_friction.empty()) {
    std::vector<double> friction;
    for (std::size_t wall = 0; wall < before.rigid_walls.size(); ++wall) {
      const auto first =
          state.rigid_wall_friction.begin() + static_cast<std::ptrdiff_t>(wall * before.particle_count());
      const auto joints = first + before.joint_count;
      friction.insert(friction.end(), first, joints);
      friction.insert(friction.end(), more, 0.0);
      friction.insert(friction.end(), joints, first + static_cast<std::ptrdiff_t>(before.particle_count()));
    }
    state.rigid_wall_friction = std::move(friction);
  }
  for (ContactLists& lists : state.contacts) {
    for (int& ball : lists.touching.ball) ball += ball >= before.joint_count ? static_cast<int>(more) : 0;
  }
  state.contact_tiles.clear();
}

State without_new_ends(const Scene& scene, const State& state) {
  State joined = state;
  const auto first = static_cast<std::ptrdiff_t>(scene.joint_count - state.breaks.size());
  const auto join = [&](auto& list) {
    if (!list.empty()) list.erase(list.begin() + first, list.begin() + scene.joint_count);
  };
  join(joined.position);
  join(joined.velocity);
  join(joined.rotation);
  join(joined.spin);
  join(joined.radius_growth);
  return joined;
}

std::shared_ptr<Scene> part_again(const Scene& first, std::span<const Break> breaks) {
  std::shared_ptr<Scene> scene;
  for (auto from = breaks.begin(); from != breaks.end();) {
    const Scene& before = scene != nullptr ? *scene : first;
    const auto to = std::find_if(from, breaks.end(), [&](const Break& at) { return at.step != from->step; });
    std::vector<FailedEnd> ends;
    for (const Break& at : std::span(from, to)) {
      const WallBlock& block =
          *std::prev(std::ranges::upper_bound(before.walls.blocks, at.element, {}, &WallBlock::first_element));
      ends.push_back({block.first_wall + (at.element - block.first_element) % block.walls, at.at_end != 0, at.plastic});
    }
    scene = part_mesh(before, ends);
    from = to;
  }
  return scene;
}

}  // namespace cellcrush
