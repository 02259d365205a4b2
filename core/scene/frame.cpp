#include "scene/frame.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace cellcrush {
namespace {

// Pinned ends of a frame's beams (E16). A pinned end is a joint of its own at the place of its node, so that it has a
// rotation of its own. The joints of a pin have the node's translation in common: all of them have equal shares of the
// mass and of the force of the whole pin, and so move by the same numbers (motion/loads.h).

/// Calls visit(beam, whether it is its start, node) for all pinned ends, in the order of their joints.
template <class Visit>
void visit_pinned_ends(const FrameWalls& frame, const Visit& visit) {
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    const FrameWalls::Beam& beam = frame.beams[b];
    if (beam.pin_start) {
      visit(b, true, beam.start);
    }
    if (beam.pin_end) {
      visit(b, false, beam.end);
    }
  }
}

/// Adds the joints of pinned ends after those of the nodes, in the order of the beams, and attaches the ends to them.
/// REQUIRES: the layout has the nodes and the beams of the frame, in their order.
void add_pinned_ends(const FrameWalls& frame, Layout& layout) {
  visit_pinned_ends(frame, [&](std::size_t beam, bool is_start, int node) {
    LayoutWall& wall = layout.walls[beam];
    (is_start ? wall.start : wall.end) = static_cast<int>(layout.joints.size());
    layout.joints.push_back(Vector2(layout.joints[node]));
  });
}

/// Fills the pins of the scene, and holds all joints of a pin in x and y as its node is held.
/// REQUIRES: the mesh of the scene is that of the layout; the nodes' supports are attached.
void group_pinned_ends(const FrameWalls& frame, Scene& scene) {
  std::vector<std::vector<int>> joints_of(frame.nodes.size());
  auto joint = static_cast<int>(frame.nodes.size());
  visit_pinned_ends(frame, [&](std::size_t, bool, int node) { joints_of[node].push_back(joint++); });
  if (joint == static_cast<int>(frame.nodes.size())) {
    return;
  }
  scene.pins.offset = {0};
  for (std::size_t node = 0; node < joints_of.size(); ++node) {
    if (joints_of[node].empty()) {
      continue;
    }
    scene.pins.joint.push_back(static_cast<int>(node));
    for (const int pinned : joints_of[node]) {
      scene.pins.joint.push_back(pinned);
      if (!scene.supports.empty()) {
        scene.supports[pinned] = {scene.supports[node].x, scene.supports[node].y, {}};
      }
    }
    scene.pins.offset.push_back(static_cast<int>(scene.pins.joint.size()));
  }
}

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

/// The walls of the beams of a frame that are no rigid links: one each, or their units where walls can break
/// (scene/unit_walls.h).
class BeamWalls {
 public:
  BeamWalls(const ListOrder& order, const Walls& walls) : walls_(walls) {
    for (int wall = 0; wall < static_cast<int>(walls.start.size()); ++wall) {
      const int beam = order.listed_wall(wall);
      if (beam == static_cast<int>(first_.size())) first_.push_back(wall);
    }
    first_.push_back(static_cast<int>(walls.start.size()));
  }

  [[nodiscard]] int count() const { return static_cast<int>(first_.size()) - 1; }
  [[nodiscard]] int start_of(int beam) const { return walls_.start[first_[beam]]; }
  [[nodiscard]] int end_of(int beam) const { return walls_.end[first_[beam + 1] - 1]; }
  [[nodiscard]] double element_length_of(int beam) const { return walls_.undeformed_length[first_[beam]]; }

  /// Calls visit(element, particle at its end) for each element of a beam, from its start on.
  template <class Visit>
  void visit(int beam, const Visit& visit) const {
    for (int wall = first_[beam]; wall < first_[beam + 1]; ++wall) {
      const WallBlock& block = *std::find_if(walls_.blocks.begin(), walls_.blocks.end(),
                                             [&](const WallBlock& of) { return wall < of.first_wall + of.walls; });
      for (int j = 0; j < block.elements; ++j) {
        const int place = j * block.walls + wall - block.first_wall;
        visit(block.first_element + place, j + 1 == block.elements ? walls_.end[wall] : block.first_inner + place);
      }
    }
  }

 private:
  const Walls& walls_;
  std::vector<int> first_;  ///< of each beam, then the end
};

void attach_loads(const LoadsSpec& loads, const BeamWalls& beams, Scene& scene) {
  for (const LoadsSpec::NodalLoad& load : loads.loads) {
    scene.loads.push_back({load.node, component_of(load.component), {load.points}});
  }
  for (const LoadsSpec::DistributedLoad& load : loads.distributed_loads) {
    const double length = beams.element_length_of(load.beam);
    beams.visit(load.beam, [&](int element, int) {
      if (!load.x_points.empty()) {
        scene.element_loads.push_back({element, Component::x, {load.x_points}, length});
      }
      if (!load.y_points.empty()) {
        scene.element_loads.push_back({element, Component::y, {load.y_points}, length});
      }
    });
  }
}

/// Rate at which the chord of a beam turns, rad/s.
double turn_of_chord(const Scene& scene, int start, int end) {
  const Vector2 span = scene.position[end] - scene.position[start];
  return normal_of(span).dot(scene.initial_velocity[end] - scene.initial_velocity[start]) / span.squaredNorm();
}

/// Moves the joints of pinned ends as their nodes, and turns them as the chords of their beams.
void move_pinned_ends(const FrameWalls& frame, const BeamWalls& beams, std::vector<bool>& named, Scene& scene) {
  for (std::size_t pin = 0; pin < scene.pins.count(); ++pin) {
    const int node = scene.pins.joints_of(pin).front();
    for (const int joint : scene.pins.joints_of(pin)) {
      scene.initial_velocity[joint] = Vector2(scene.initial_velocity[node]);
      named[joint] = named[node];
    }
  }
  for (int beam = 0; beam < beams.count(); ++beam) {
    const int start = beams.start_of(beam);
    const int end = beams.end_of(beam);
    for (const auto& [joint, is_pinned] :
         {std::pair(start, frame.beams[beam].pin_start), std::pair(end, frame.beams[beam].pin_end)}) {
      if (is_pinned && named[start] && named[end]) {
        scene.initial_spin[joint] = turn_of_chord(scene, start, end);
      }
    }
  }
}

/// Gives velocities to the particles inside a beam (E14b).
void move_inside(const BeamWalls& beams, int beam, Scene& scene) {
  const int start = beams.start_of(beam);
  const int end = beams.end_of(beam);
  const Vector2 span = scene.position[end] - scene.position[start];
  const Vector2 across = normal_of(span);  // n L
  const Vector2 from = scene.initial_velocity[start];
  const Vector2 to = scene.initial_velocity[end];
  const double turn = turn_of_chord(scene, start, end);
  const double at_start = scene.initial_spin[start] - turn;
  const double at_end = scene.initial_spin[end] - turn;
  int elements = 0;
  beams.visit(beam, [&](int, int) { ++elements; });
  int passed = 0;
  beams.visit(beam, [&](int, int i) {
    if (++passed == elements) return;
    const double s = static_cast<double>(passed) / elements;
    const double r = 1.0 - s;
    scene.initial_velocity[i] = r * from + s * to + across * (s * r * (r * at_start - s * at_end));
    scene.initial_spin[i] = turn + r * (1.0 - 3.0 * s) * at_start + s * (3.0 * s - 2.0) * at_end;
  });
}

/// Fills initial_velocity and initial_spin of the scene. Nodes have what the frame gives them; all others are at rest.
/// Inside a beam whose two nodes are both named, velocities are those of a beam element between them (E14b). V_1, V_2
/// and omega_1, omega_2 are the velocities and spins of its nodes, L its length, n its normal and s the place along it:
///   Omega    = n . (V_2 - V_1) / L
///   v(s)     = (1 - s) V_1 + s V_2 + n L [s (1 - s)^2 (omega_1 - Omega) - s^2 (1 - s) (omega_2 - Omega)]
///   omega(s) = Omega + (1 - 4 s + 3 s^2) (omega_1 - Omega) + (3 s^2 - 2 s) (omega_2 - Omega).
/// A rigid motion of its nodes is thus a rigid motion of the beam. A beam with a node that is not named is at rest
/// inside, so that a mass at its end can strike it.
/// Pinned ends turn as the chord of their beam, Omega.
/// REQUIRES: the mesh of the scene is that of the frame; its pins are grouped.
void attach_initial_velocities(const FrameWalls& frame, const BeamWalls& beams,
                               const std::vector<LoadsSpec::InitialVelocity>& velocities, Scene& scene) {
  if (velocities.empty()) {
    return;
  }
  scene.initial_velocity.assign(scene.particle_count(), Vector2::Zero());
  scene.initial_spin.assign(scene.particle_count(), 0.0);
  std::vector<bool> named(static_cast<std::size_t>(scene.joint_count), false);
  for (const LoadsSpec::InitialVelocity& velocity : velocities) {
    scene.initial_velocity[velocity.node] = Vector2(velocity.x_m_per_s, velocity.y_m_per_s) * kMmPerM;
    scene.initial_spin[velocity.node] = velocity.rotation_rad_per_s;
    named[velocity.node] = true;
  }
  move_pinned_ends(frame, beams, named, scene);
  for (int beam = 0; beam < beams.count(); ++beam) {
    if (named[beams.start_of(beam)] && named[beams.end_of(beam)]) {
      move_inside(beams, beam, scene);
    }
  }
}

}  // namespace

Layout lay_out_frame(const FrameWalls& frame, int elements_per_wall, int links) {
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
  for (LayoutWall& link : std::span(layout.walls).last(static_cast<std::size_t>(links))) {
    link.rigid = true;
    link.elements = 1;
  }
  add_pinned_ends(frame, layout);
  return layout;
}

void attach_to_frame(const FrameWalls& frame, const ListOrder& order, const LoadsSpec& loads, Scene& scene) {
  const std::size_t count = scene.particle_count();
  scene.mass.assign(count, 0.0);
  scene.inertia.assign(count, 0.0);
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    scene.mass[i] = frame.nodes[i].attached_mass_g * kTonnePerGram;
    scene.inertia[i] = frame.nodes[i].attached_inertia_g_mm2 * kTonnePerGram;
  }
  attach_holds(frame, loads, scene);
  group_pinned_ends(frame, scene);
  const BeamWalls beams(order, scene.walls);
  attach_loads(loads, beams, scene);
  attach_initial_velocities(frame, beams, loads.initial_velocities, scene);
  scene.watched = frame.watched_nodes;
}

void share_pin_masses(Scene& scene) {
  for (std::size_t pin = 0; pin < scene.pins.count(); ++pin) {
    double mass = 0.0;
    for (const int joint : scene.pins.joints_of(pin)) {
      mass += scene.mass[joint];
    }
    for (const int joint : scene.pins.joints_of(pin)) {
      scene.mass[joint] = mass / static_cast<double>(scene.pins.joints_of(pin).size());
    }
  }
}

}  // namespace cellcrush
