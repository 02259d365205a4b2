#include "scenes/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush::scenes {

void put_frame(const FrameLattice& frame, SceneSpec& spec) {
  spec.lattice = static_cast<const FrameWalls&>(frame);
  spec.loads = frame;
  spec.loading.end_time_s = frame.end_time_s;
}

std::shared_ptr<Scene> build(const SceneSpec& spec) {
  const SceneResult result = build_scene(spec);
  for (const Problem& problem : result.problems) {
    ADD_FAILURE() << problem.field << " = " << problem.value << ": " << problem.message << " " << problem.remedy;
  }
  return result.scene ? std::make_shared<Scene>(*result.scene) : nullptr;
}

FrameLattice::Beam beam(int start, int end, double thickness_mm, int elements) {
  return {start, end, thickness_mm, elements, std::nullopt};
}

SceneSpec elastic_frame(FrameLattice frame) {
  frame.end_time_s = frame.end_time_s.value_or(1.0);
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = 70000.0;
  spec.material.yield_stress_mpa = 1e9;
  spec.material.density_kg_per_m3 = kDensity;
  return spec;
}

double Cantilever::first_frequency() {
  constexpr double kMassPerLength = 7.85e-9;
  return 3.516 * std::sqrt(kStiffness / kMassPerLength) / (kLength * kLength);
}

SceneSpec Cantilever::spec(int elements, FrameLattice::Component component, double value, double rise_time,
                           double end_time) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, 1.0, elements)};
  frame.supports = {{0, true, true, true}};
  frame.loads = {{1, component, {{0.0, 0.0}, {rise_time, value}}}};
  frame.end_time_s = end_time;
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = 200000.0;
  spec.material.yield_stress_mpa = 1e9;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.numerics.mass_damping_per_s = 2.0 * first_frequency();
  return spec;
}

SceneSpec hexagon_specimen(int columns, int rows) {
  SceneSpec spec = scenes::preset("hexagon-small");
  auto& hexagon = scenes::cells_of(spec);
  hexagon.columns = columns;
  hexagon.rows = rows;
  return spec;
}

void stir(Scene& scene, double speed) {
  std::mt19937_64 generator(20261120);
  const auto draw = [&] { return speed * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0); };
  scene.initial_velocity.clear();
  scene.initial_spin.clear();
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    scene.initial_velocity.emplace_back(draw(), draw());
    scene.initial_spin.push_back(draw());
  }
}

}  // namespace cellcrush::scenes
