#include "scene/frame.h"

#include <algorithm>

#include "scene/initial_velocity.h"
#include "scene/pins.h"

namespace cellcrush {
namespace {

Component component_of(LoadsSpec::Component component) {
  switch (component) {
    case LoadsSpec::Component::x: return Component::x;
    case LoadsSpec::Component::y: return Component::y;
    case LoadsSpec::Component::rotation: break;
  }
  return Component::rotation;
}

void attach_holds(const FrameWalls& frame, const LoadsSpec& loads, Scene& scene) {
  if (frame.supports.empty() && loads.motions.empty()) {
    return;
  }
  scene.supports.assign(scene.particle_count(), {});
  for (const FrameWalls::Support& support : frame.supports) {
    Support& held = scene.supports[support.node];
    held.x.held |= support.fix_x;
    held.y.held |= support.fix_y;
    held.rotation.held |= support.fix_rotation;
  }
  for (const LoadsSpec::NodalMotion& motion : loads.motions) {
    Support& held = scene.supports[motion.node];
    const Component component = component_of(motion.component);
    Hold& hold = component == Component::x ? held.x : component == Component::y ? held.y : held.rotation;
    hold = {true, static_cast<int>(scene.motions.size())};
    scene.motions.push_back({motion.points});
  }
}

/// The block of a beam; the beams of a frame are its walls.
const WallBlock& block_of(const Walls& walls, int beam) {
  return *std::find_if(walls.blocks.begin(), walls.blocks.end(),
                       [&](const WallBlock& block) { return beam < block.first_wall + block.walls; });
}

void attach_loads(const LoadsSpec& loads, Scene& scene) {
  for (const LoadsSpec::NodalLoad& load : loads.loads) {
    scene.loads.push_back({load.node, component_of(load.component), {load.points}});
  }
  for (const LoadsSpec::DistributedLoad& load : loads.distributed_loads) {
    const WallBlock& block = block_of(scene.walls, load.beam);
    const double length = scene.walls.undeformed_length[load.beam];
    for (int j = 0; j < block.elements; ++j) {
      const int e = block.first_element + j * block.walls + load.beam - block.first_wall;
      if (!load.x_points.empty()) {
        scene.element_loads.push_back({e, Component::x, {load.x_points}, length});
      }
      if (!load.y_points.empty()) {
        scene.element_loads.push_back({e, Component::y, {load.y_points}, length});
      }
    }
  }
}

}  // namespace

Layout lay_out_frame(const FrameWalls& frame, int elements_per_wall) {
  Layout layout;
  for (const FrameWalls::Node& node : frame.nodes) {
    layout.joints.emplace_back(node.x_mm, node.y_mm);
  }
  int own_materials = 0;
  for (const FrameWalls::Beam& beam : frame.beams) {
    const int material = beam.material ? ++own_materials : 0;
    layout.walls.push_back(
        {beam.start, beam.end, beam.thickness_mm, beam.elements.value_or(elements_per_wall), material});
  }
  add_pinned_ends(frame, layout);
  return layout;
}

void attach_to_frame(const FrameWalls& frame, const LoadsSpec& loads, Scene& scene) {
  const std::size_t count = scene.particle_count();
  scene.mass.assign(count, 0.0);
  scene.inertia.assign(count, 0.0);
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    scene.mass[i] = frame.nodes[i].attached_mass_g * kTonnePerGram;
    scene.inertia[i] = frame.nodes[i].attached_inertia_g_mm2 * kTonnePerGram;
  }
  attach_holds(frame, loads, scene);
  group_pinned_ends(frame, scene);
  attach_loads(loads, scene);
  attach_initial_velocities(frame, loads.initial_velocities, scene);
  scene.watched = frame.watched_nodes;
}

}  // namespace cellcrush
