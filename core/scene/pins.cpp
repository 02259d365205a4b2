#include "scene/pins.h"

#include <vector>

namespace cellcrush {
namespace {

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

}  // namespace

void add_pinned_ends(const FrameWalls& frame, Layout& layout) {
  visit_pinned_ends(frame, [&](std::size_t beam, bool is_start, int node) {
    LayoutWall& wall = layout.walls[beam];
    (is_start ? wall.start : wall.end) = static_cast<int>(layout.joints.size());
    layout.joints.push_back(Vector2(layout.joints[node]));
  });
}

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
