#include "scenes/rigid_walls.h"

#include <cmath>
#include <utility>

#include "cellcrush/vector.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush::scenes {
namespace {

constexpr double kAluminium = 70000.0;     // E of elastic_frame, MPa
constexpr double kAluminiumMass = 2.7e-9;  // its density, tonne / mm^3
constexpr double kMetrePerMillimetre = 1e-3;

}  // namespace

double FallingBar::wave_speed() { return std::sqrt(kAluminium / kAluminiumMass); }
double FallingBar::duration() { return 2.0 * kLength / wave_speed(); }
double FallingBar::meeting() { return kGap / kSpeed; }
double FallingBar::force() { return kSpeed * kAluminium * kThickness / wave_speed(); }
double FallingBar::momentum() { return kAluminiumMass * kThickness * kLength * kSpeed; }

SceneSpec FallingBar::spec(int elements) {
  FrameLattice frame = bar(kLength, kThickness, elements);
  const double speed = -kSpeed * kMetrePerMillimetre;
  frame.initial_velocities = {{0, speed, 0.0, 0.0}, {1, speed, 0.0, 0.0}};
  frame.rigid_walls = {{-0.5 * kThickness - kGap, 0.0, 1.0, 0.0, 0.0, {}}};
  frame.end_time_s = meeting() + 1.5 * duration();
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.contact.damping_ratio = 0.0;
  spec.contact.stiffness_factor = 0.25;
  spec.output.sample_count = 600;
  return spec;
}

SceneSpec SlopedBlock::spec(double end_time) const {
  // Down the slope, and out of it.
  const Vector2 down = direction(-incline_);
  const Vector2 out = normal_of(down);
  const Vector2 start = 0.5 * kThickness * out;
  const Vector2 end = start + kLength * down;
  FrameLattice frame;
  frame.nodes = {{start.x(), start.y(), 0.0, 0.0}, {end.x(), end.y(), 0.0, 0.0}};
  frame.beams = {beam(0, 1, kThickness, 1)};
  frame.rigid_walls = {{0.0, 0.0, 2.0 * out.x(), 2.0 * out.y(), kFriction, {}}};
  frame.gravity_y_m_per_s2 = -kGravity * kMetrePerMillimetre;
  frame.watched_nodes = {0};
  frame.end_time_s = end_time;
  return elastic_frame(std::move(frame));
}

double SlopedBlock::way(const Sample& sample) const {
  return Vector2(sample.watched.at(0).ux, sample.watched.at(0).uy).dot(direction(-incline_));
}

double SlopedBlock::weight_across() const {
  return kAluminiumMass * kThickness * kLength * kGravity * std::cos(incline_);
}

double SlopedBlock::weight_along() const {
  return kAluminiumMass * kThickness * kLength * kGravity * std::sin(incline_);
}

double SlopedBlock::acceleration() const { return kGravity * (std::sin(incline_) - kFriction * std::cos(incline_)); }

SceneSpec TossedFrame::spec(double angle, double yield_stress_mpa) {
  const Vector2 x = direction(angle);
  const Vector2 y = normal_of(x);
  const auto turned = [&](double along, double up) -> Vector2 { return along * x + up * y; };
  FrameLattice frame;
  // Stands askew, so that one corner strikes first.
  for (const auto& [along, up] : {std::pair{0.3, 0.1}, {1.25, 0.4}, {0.95, 1.35}, {0.0, 1.05}}) {
    const Vector2 place = kSide * turned(along, up);
    frame.nodes.push_back({place.x(), place.y(), 0.0, 0.0});
  }
  for (int i = 0; i < 4; ++i) {
    frame.beams.push_back(beam(i, (i + 1) % 4, 1.0, 4));
    const Vector2 speed = turned(20.0, -15.0);  // m/s
    frame.initial_velocities.push_back({i, speed.x(), speed.y(), 0.0});
    frame.watched_nodes.push_back(i);
  }
  const Vector2 gravity = turned(0.0, -9.81);
  frame.gravity_x_m_per_s2 = gravity.x();
  frame.gravity_y_m_per_s2 = gravity.y();
  constexpr double kEnd = 4e-3;  // s
  const Vector2 point = turned(-3.0, 0.0);
  frame.rigid_walls = {
      {point.x(), point.y(), y.x(), y.y(), 0.2, {{0.0, 0.0}, {kEnd + 1.0, kWallSpeed * (kEnd + 1.0)}}}};
  frame.end_time_s = kEnd;
  SceneSpec spec = in_double_precision(elastic_frame(std::move(frame)));
  spec.material.yield_stress_mpa = yield_stress_mpa;
  return spec;
}

double mass_in_grams(const SceneSpec& spec) { return 1e6 * build(spec)->total_mass; }

SceneSpec struck_hexagons(double mass_g, double speed_m_per_s) {
  SceneSpec spec = hexagon_specimen(4, 3);
  const double height = (1.5 * 3 + 0.5) * *cells_of(spec).side_mm;
  const double radius = 0.5 * *cells_of(spec).wall_thickness_mm;
  spec.loading.speed_m_per_s.reset();
  spec.loading.end_time_s = 1e-3;
  spec.loads.rigid_walls = {{3.0, height + 1.001 * radius, 0.0, -1.0}};
  spec.loads.rigid_walls[0].own = {{"mass_g", mass_g}, {"speed_m_per_s", speed_m_per_s}};
  return in_double_precision(std::move(spec));
}

SceneSpec stopped_mass() {
  SceneSpec spec = struck_hexagons(1.0, 15.0);
  spec.loads.rigid_walls[0].own["mass_g"] = 2.0 * mass_in_grams(spec);
  spec.loads.rigid_walls.push_back({0.0, -0.5001 * *cells_of(spec).wall_thickness_mm, 0.0, 1.0});
  spec.loads.gravity_y_m_per_s2 = -1000.0;
  spec.numerics.mass_damping_per_s = 2e4;
  spec.loading.end_time_s = 0.02;
  spec.loading.end_at_rest = 1e-8;
  return spec;
}

}  // namespace cellcrush::scenes
