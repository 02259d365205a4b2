#include "scenes/beam_over_beam.h"

#include "scenes/frames.h"

namespace cellcrush::scenes {

SceneSpec beam_over_beam(double speed_m_per_s, double gravity_m_per_s2) {
  FrameLattice frame;
  frame.nodes = {{-40.0, 0.0, 0.0, 0.0}, {40.0, 0.0, 0.0, 0.0}, {-5.0, 1.01, 0.0, 0.0}, {5.0, 1.01, 0.0, 0.0}};
  frame.beams = {beam(0, 1, 1.0, 1), beam(2, 3, 1.0, 1)};
  frame.supports = {{0, true, true, true}, {1, true, true, true}};
  frame.initial_velocities = {{2, 0.0, -speed_m_per_s, 0.0}, {3, 0.0, -speed_m_per_s, 0.0}};
  frame.gravity_y_m_per_s2 = -gravity_m_per_s2;
  frame.self_contact = true;
  SceneSpec spec = elastic_frame(frame);
  spec.contact.damping_ratio = 0.0;
  return spec;
}

}  // namespace cellcrush::scenes
