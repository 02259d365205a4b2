#include "scenes/unit_cells.h"

#include <cmath>
#include <vector>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

constexpr double kSide = UnitCell::kSide;

/// First natural frequency of a half wall as a cantilever, 1/s.
double half_wall_frequency(double thickness) {
  const double wave_speed = std::sqrt(UnitCell::kModulus / (kDensity * 1e-12));
  return 3.516 * wave_speed * thickness / std::sqrt(12.0) / (0.25 * kSide * kSide);
}

/// A case whose loads or motions rise over `rise` and rest as long again; times are in radians of half a wall's
/// frequency.
SceneSpec slow_frame(FrameLattice frame, double thickness, double rise, double damping) {
  const double frequency = half_wall_frequency(thickness);
  const double rise_time = rise / frequency;
  for (auto& load : frame.loads) {
    load.points.back().first = rise_time;
  }
  for (auto& motion : frame.motions) {
    motion.points.back().first = rise_time;
  }
  frame.end_time_s = 2.0 * rise_time;
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.material.youngs_modulus_mpa = UnitCell::kModulus;
  spec.material.density_kg_per_m3 = kDensity;
  spec.numerics.mass_damping_per_s = damping * frequency;
  spec.output.sample_count = 20;
  return spec;
}

/// A rise from 0 to `value`; slow_frame says when.
FrameLattice::TimeFunction rise_to(double value) { return {{0.0, 0.0}, {1.0, value}}; }

FrameLattice half_hexagon(double thickness, int elements) {
  FrameLattice frame;
  frame.nodes = {
      {0.0, 0.0, 0.0, 0.0}, {0.0, -0.5 * kSide, 0.0, 0.0}, {UnitCell::kHexagonWidth, 0.25 * kSide, 0.0, 0.0}};
  frame.beams = {beam(0, 1, 0.5 * thickness, elements), beam(0, 2, thickness, elements)};
  frame.supports = {{0, true, false, true}, {1, true, true, true}};
  frame.watched_nodes = {2};
  return frame;
}

/// Half walls from one joint in these directions, each with its opposite, and their ends moved evenly.
SceneSpec strained_joint(const std::vector<double>& angles, double thickness, double strain_x, double strain_y) {
  FrameLattice frame;
  frame.nodes.push_back({0.0, 0.0, 0.0, 0.0});
  for (const double angle : angles) {
    for (const double sign : {1.0, -1.0}) {
      const double x = sign * 0.5 * kSide * std::cos(angle);
      const double y = sign * 0.5 * kSide * std::sin(angle);
      const int node = static_cast<int>(frame.nodes.size());
      frame.nodes.push_back({x, y, 0.0, 0.0});
      frame.beams.push_back(beam(0, node, thickness, 2));
      frame.motions.push_back({node, Component::x, rise_to(strain_x * x)});
      frame.motions.push_back({node, Component::y, rise_to(strain_y * y)});
    }
  }
  return slow_frame(std::move(frame), thickness, 60.0, 1.0);
}

}  // namespace

SceneSpec UnitCell::loaded_hexagon(double thickness, double load_x, double load_y) {
  FrameLattice frame = half_hexagon(thickness, 2);
  frame.loads = {{2, Component::x, rise_to(load_x)}, {2, Component::y, rise_to(load_y)}};
  return slow_frame(std::move(frame), thickness, 60.0, 1.0);
}

SceneSpec UnitCell::crushed_hexagon(double thickness, double yield_stress, double strain, int elements,
                                    const SectionSpec& section) {
  FrameLattice frame = half_hexagon(thickness, elements);
  frame.motions = {{2, Component::y, rise_to(-strain * kHexagonHeight)}};
  SceneSpec spec = slow_frame(std::move(frame), thickness, 1500.0, 0.2);
  spec.loading.end_time_s = spec.loads.motions.front().points.back().first;
  spec.material.yield_stress_mpa = yield_stress;
  spec.section = section;
  spec.output.sample_count = 200;
  return spec;
}

SceneSpec UnitCell::strained_triangle(double thickness, double strain_x, double strain_y) {
  return strained_joint({0.0, std::numbers::pi / 3.0, 2.0 * std::numbers::pi / 3.0}, thickness, strain_x, strain_y);
}

SceneSpec UnitCell::strained_square(double thickness, double strain_x, double strain_y) {
  return strained_joint({0.0, 0.5 * std::numbers::pi}, thickness, strain_x, strain_y);
}

SceneSpec UnitCell::strained_hexagon_strip(double thickness, int columns, double strain) {
  const double pitch = 0.5 * std::numbers::sqrt3 * kSide;
  FrameLattice frame;
  for (int i = 0; i <= 2 * columns; ++i) {
    const bool low = i % 2 == 0;
    const int joint = static_cast<int>(frame.nodes.size());
    frame.nodes.push_back({i * pitch, low ? 0.0 : 0.5 * kSide, 0.0, 0.0});
    frame.nodes.push_back({i * pitch, low ? -0.5 * kSide : kSide, 0.0, 0.0});
    frame.beams.push_back(beam(joint, joint + 1, thickness, 1));
    if (i > 0) {
      frame.beams.push_back(beam(joint - 2, joint, thickness, 1));
    }
    frame.supports.push_back({joint + 1, i == 0, low, true});
    if (!low) {
      frame.motions.push_back({joint + 1, Component::y, rise_to(-strain * 1.5 * kSide)});
    }
  }
  return slow_frame(std::move(frame), thickness, 250.0 * columns, 1.0 / columns);
}

}  // namespace cellcrush::scenes
