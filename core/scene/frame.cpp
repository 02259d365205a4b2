#include "scene/frame.h"

namespace cellcrush {
namespace {

constexpr double kTonnePerGram = 1e-6;
constexpr double kMmPerM = 1e3;

NodalLoad::Component component_of(FrameLattice::Component component) {
  switch (component) {
    case FrameLattice::Component::x: return NodalLoad::Component::x;
    case FrameLattice::Component::y: return NodalLoad::Component::y;
    case FrameLattice::Component::rotation: break;
  }
  return NodalLoad::Component::rotation;
}

}  // namespace

Layout lay_out_frame(const FrameLattice& frame, int elements_per_wall) {
  Layout layout;
  for (const FrameLattice::Node& node : frame.nodes) {
    layout.joints.emplace_back(node.x_mm, node.y_mm);
  }
  for (const FrameLattice::Beam& beam : frame.beams) {
    layout.walls.push_back({beam.start, beam.end, beam.thickness_mm, beam.elements.value_or(elements_per_wall)});
  }
  return layout;
}

void attach_to_frame(const FrameLattice& frame, Scene& scene) {
  const std::size_t count = scene.particle_count();
  scene.mass.assign(count, 0.0);
  scene.inertia.assign(count, 0.0);
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    scene.mass[i] = frame.nodes[i].attached_mass_g * kTonnePerGram;
    scene.inertia[i] = frame.nodes[i].attached_inertia_g_mm2 * kTonnePerGram;
  }
  if (!frame.supports.empty()) {
    scene.supports.assign(count, {});
    for (const FrameLattice::Support& support : frame.supports) {
      scene.supports[support.node] = {support.fix_x, support.fix_y, support.fix_rotation};
    }
  }
  for (const FrameLattice::NodalLoad& load : frame.loads) {
    scene.loads.push_back({load.node, component_of(load.component), load.points});
  }
  if (!frame.initial_velocities.empty()) {
    scene.initial_velocity.assign(count, Vector2::Zero());
    scene.initial_spin.assign(count, 0.0);
    for (const FrameLattice::InitialVelocity& velocity : frame.initial_velocities) {
      scene.initial_velocity[velocity.node] = Vector2(velocity.x_m_per_s, velocity.y_m_per_s) * kMmPerM;
      scene.initial_spin[velocity.node] = velocity.rotation_rad_per_s;
    }
  }
}

}  // namespace cellcrush
