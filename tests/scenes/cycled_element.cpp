#include "scenes/cycled_element.h"

#include <utility>

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

SceneSpec cycled(FrameLattice frame, const MaterialSpec& material) {
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {CycledElement::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, CycledElement::kThickness, 1)};
  frame.end_time_s = (4.0 * CycledElement::kCycles - 1.0) * CycledElement::kQuarter;
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.material = material;
  spec.numerics.time_step_s = CycledElement::kQuarter / 512.0;  // a step ends at every turn
  return spec;
}

}  // namespace

FrameLattice::TimeFunction CycledElement::to_and_fro(double amplitude) {
  FrameLattice::TimeFunction points = {{0.0, 0.0}};
  for (int i = 0; i < kCycles; ++i) {
    points.emplace_back((4.0 * i + 1.0) * kQuarter, amplitude);
    points.emplace_back((4.0 * i + 3.0) * kQuarter, -amplitude);
  }
  return points;
}

SceneSpec CycledElement::stretched(double amplitude, const MaterialSpec& material) {
  FrameLattice frame;
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  frame.motions = {{1, Component::x, to_and_fro(amplitude * kLength)}};
  SceneSpec spec = cycled(std::move(frame), material);
  spec.section.area_rule = SectionSpec::AreaRule::constant_area;
  return spec;
}

SceneSpec CycledElement::bent(double curvature, const MaterialSpec& material, int depth_points) {
  FrameLattice frame;
  frame.supports = {{0, true, true, false}, {1, true, true, false}};
  frame.motions = {{0, Component::rotation, to_and_fro(-0.5 * kLength * curvature)},
                   {1, Component::rotation, to_and_fro(0.5 * kLength * curvature)}};
  SceneSpec spec = cycled(std::move(frame), material);
  spec.section.depth_points = depth_points;
  return spec;
}

void CycledElement::run(const SceneSpec& spec, const std::function<void(double)>& turn,
                        const std::function<void(double, double, double)>& visit) {
  const auto scene = build(spec);
  Simulation simulation(scene);
  int turns = 0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    for (; simulation.time() > (2.0 * turns + 1.0) * kQuarter * (1.0 + 1e-9); ++turns) {
      turn(turns % 2 == 0 ? 1.0 : -1.0);
    }
    visit(simulation.time(), -simulation.state().internal_force[1].x(), -simulation.state().internal_moment[1]);
  }
  EXPECT_EQ(simulation.step(), scene->schedule.step_count) << simulation.status().message;
}

}  // namespace cellcrush::scenes
