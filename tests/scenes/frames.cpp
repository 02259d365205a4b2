#include "scenes/frames.h"

#include <algorithm>
#include <random>

#include "cellcrush/fidelity.h"
#include "cellcrush/simd.h"
#include "lattice/lattice.h"
#include "scene/frame.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "step/advance_step.h"

namespace cellcrush::scenes {

void put_frame(const FrameLattice& frame, SceneSpec& spec) {
  spec.lattice = frame.walls();
  spec.loads = frame.acting();
  spec.loading.end_time_s = frame.end_time_s;
}

FrameLattice::Beam beam(int start, int end, double thickness_mm, int elements) {
  return {start, end, thickness_mm, elements, {}};
}

FrameLattice bar(double length_mm, double thickness_mm, int elements) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {length_mm, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, thickness_mm, elements)};
  return frame;
}

FrameLattice touching_beams(const std::vector<Vector2>& nodes, const std::vector<std::pair<int, int>>& beams,
                            double thickness_mm, int elements) {
  FrameLattice frame;
  for (const Vector2& node : nodes) frame.nodes.push_back({node.x(), node.y(), 0.0, 0.0});
  for (const auto& [start, end] : beams) frame.beams.push_back(beam(start, end, thickness_mm, elements));
  frame.self_contact = true;
  return frame;
}

SceneSpec elastic_frame(FrameLattice frame) { return plastic_frame(std::move(frame), 70000.0, 1e9, kDensity); }

SceneSpec plastic_frame(FrameLattice frame, double modulus, double yield_stress, double density) {
  frame.end_time_s = frame.end_time_s.value_or(1.0);
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = modulus;
  spec.material.yield_stress_mpa = yield_stress;
  spec.material.density_kg_per_m3 = density;
  return spec;
}

SceneSpec in_double_precision(SceneSpec spec) {
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  return spec;
}

SceneSpec in_single_precision(SceneSpec spec) {
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::single_precision;
  return spec;
}

double Cantilever::first_frequency() {
  constexpr double kMassPerLength = 7.85e-9;
  return 3.516 * std::sqrt(kStiffness / kMassPerLength) / (kLength * kLength);
}

SceneSpec Cantilever::spec(int elements, FrameLattice::Component component, double value, double rise_time,
                           double end_time) {
  FrameLattice frame = bar(kLength, 1.0, elements);
  frame.supports = {{0, true, true, true}};
  frame.loads = {{1, component, {{0.0, 0.0}, {rise_time, value}}}};
  frame.end_time_s = end_time;
  SceneSpec spec = plastic_frame(std::move(frame), 200000.0, 1e9);
  spec.numerics.mass_damping_per_s = 2.0 * first_frequency();
  return spec;
}

SceneSpec beam_over_beam(double speed_m_per_s, double gravity_m_per_s2) {
  FrameLattice frame = touching_beams({{-40.0, 0.0}, {40.0, 0.0}, {-5.0, 1.01}, {5.0, 1.01}}, {{0, 1}, {2, 3}}, 1.0, 1);
  frame.supports = {{0, true, true, true}, {1, true, true, true}};
  frame.initial_velocities = {{2, 0.0, -speed_m_per_s, 0.0}, {3, 0.0, -speed_m_per_s, 0.0}};
  frame.gravity_y_m_per_s2 = -gravity_m_per_s2;
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.contact.damping_ratio = 0.0;
  return spec;
}

SceneSpec hexagon_specimen(int columns, int rows) {
  SceneSpec spec = scenes::preset("hexagon-small");
  auto& hexagon = scenes::cells_of(spec);
  hexagon.columns = columns;
  hexagon.rows = rows;
  return spec;
}

std::shared_ptr<Scene> build(const SceneSpec& spec) {
  const SceneResult result = build_scene(spec);
  for (const Problem& problem : result.problems) {
    ADD_FAILURE() << problem.field << " = " << problem.value << ": " << problem.message << " " << problem.remedy;
  }
  return result.scene ? std::make_shared<Scene>(*result.scene) : nullptr;
}

SceneSpec listed(SceneSpec spec) {
  const auto scene = build(spec);
  FrameLattice frame;
  for (int joint = 0; joint < scene->joint_count; ++joint) {
    frame.nodes.push_back({scene->position[joint].x(), scene->position[joint].y(), 0.0, 0.0});
  }
  for (std::size_t w = 0; w < scene->walls.start.size(); ++w) {
    const int elements = scene->walls.blocks.front().elements;
    frame.beams.push_back(beam(scene->walls.start[w], scene->walls.end[w], scene->walls.thickness[w], elements));
  }
  frame.self_contact = true;
  put_frame(frame, spec);
  spec.imperfection = {};
  return spec;
}

SceneSpec as_network(const SceneSpec& spec) {
  SceneSpec out = fill_in_fidelity(spec);
  const auto* frame = std::get_if<FrameWalls>(&spec.lattice);
  const Layout layout =
      frame == nullptr ? kind_of(out)->lay_out(out) : lay_out_frame(*frame, *out.elements_per_wall, 0);
  NetworkWalls network;
  for (const Vector2& joint : layout.joints) {
    network.joints_mm.insert(network.joints_mm.end(), {joint.x(), joint.y()});
  }
  for (const LayoutWall& wall : layout.walls) {
    network.walls.insert(network.walls.end(), {wall.start, wall.end});
    network.thicknesses_mm.push_back(wall.thickness);
    network.rises_mm.push_back(wall.rise);
  }
  if (std::ranges::all_of(network.rises_mm, [](double rise) { return rise == 0.0; })) network.rises_mm.clear();
  out.lattice = std::move(network);
  return out;
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

std::vector<Sample> run_to_end(Simulation& simulation) {
  std::vector<Sample> samples;
  watch(simulation, [&](const Sample& sample) { samples.push_back(sample); });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return samples;
}

std::vector<Sample> run_frame(const SceneSpec& spec) {
  const auto scene = build(spec);
  if (scene == nullptr) return {};
  Simulation simulation(scene);
  return run_to_end(simulation);
}

State state_after(const Scene& scene, int steps) {
  State state = make_initial_state(scene);
  for (int i = 0; i < steps; ++i) advance_step(scene, state, nullptr);
  return state;
}

Momentum momentum_of(const Scene& scene, const State& state) {
  Momentum sum;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const Vector2 momentum = scene.mass[i] * state.velocity[i];
    sum.linear += momentum;
    sum.angular += cross(state.position[i], momentum) + scene.inertia[i] * state.spin[i];
  }
  return sum;
}

double distance_between(const State& one, const State& other) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < one.position.size(); ++i) {
    greatest = std::max(greatest, (one.position[i] - other.position[i]).norm());
  }
  return greatest;
}

std::string name_of(RunStatus::Kind kind) {
  switch (kind) {
    case RunStatus::Kind::running: return "running";
    case RunStatus::Kind::finished: return "finished";
    case RunStatus::Kind::diverged: return "diverged";
    case RunStatus::Kind::large_rotation: return "large_rotation";
    case RunStatus::Kind::energy_balance: return "energy_balance";
    case RunStatus::Kind::contact_energy: return "contact_energy";
    case RunStatus::Kind::wall_crossing: return "wall_crossing";
    case RunStatus::Kind::contact_lost: return "contact_lost";
    case RunStatus::Kind::inertia: return "inertia";
    case RunStatus::Kind::overcompaction: break;
  }
  return "overcompaction";
}

std::string name_of(CrushMode mode) {
  switch (mode) {
    case CrushMode::none: return "none";
    case CrushMode::x: return "X";
    case CrushMode::v: return "V";
    case CrushMode::i: return "I";
    case CrushMode::c: return "C";
    case CrushMode::mixed: break;
  }
  return "mixed";
}

std::string bits_of_target(const std::string& target) { return target.starts_with("avx") ? "fused" : "separate"; }

std::vector<std::string> distinct_targets() {
  std::vector<std::string> targets = simd_targets();
  const auto repeated = std::ranges::unique(targets, {}, bits_of_target);
  targets.erase(repeated.begin(), repeated.end());
  return targets;
}

}  // namespace cellcrush::scenes
