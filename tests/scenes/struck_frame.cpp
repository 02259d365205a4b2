#include "scenes/struck_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

constexpr double kMetres = 1e-3;
constexpr double kGrams = 1e6;
constexpr int kTop = 4;
constexpr int kBar = 5;  // first of its three nodes

/// Writes the parts of a frame as a view has them.
class FrameWriter {
 public:
  explicit FrameWriter(const View& view) : view_(view), force_(view.stress * view.length * view.length) {}

  void node(double x, double y, double mass) {
    const Vector2 place = view_.length * view_.turned({x, y});
    const double attached = mass * density() * std::pow(view_.length, 3) * kGrams;
    frame.nodes.push_back({place.x(), place.y(), attached, 0.5 * attached * view_.length * view_.length});
  }

  void beam(int start, int end, double thickness, int elements) {
    frame.beams.push_back(scenes::beam(start, end, thickness * view_.length, elements));
  }

  /// A node that goes steadily to `way`, or is held where that is 0, and moves with the boost.
  void moved_node(int node, const Vector2& way, bool fix_rotation) {
    const bool held = way.isZero() && view_.boost.isZero();
    frame.supports.push_back({node, held, held, fix_rotation});
    if (held) return;
    const double end = 1.1 * StruckFrame::kEnd * view_.time;
    const Vector2 travel = view_.length * view_.turned(1.1 * way) + end * view_.boost;
    frame.motions.push_back({node, Component::x, {{0.0, 0.0}, {end, travel.x()}}});
    frame.motions.push_back({node, Component::y, {{0.0, 0.0}, {end, travel.y()}}});
  }

  void velocity(int node, const Vector2& velocity, double spin) {
    const Vector2 speed = (view_.length / view_.time * view_.turned(velocity) + view_.boost) * kMetres;
    frame.initial_velocities.push_back({node, speed.x(), speed.y(), sense() * spin / view_.time});
  }

  void load(int node, const Vector2& force, double moment) {
    const Vector2 turned = force_ * view_.turned(force);
    frame.loads.push_back({node, Component::x, {{0.0, turned.x()}}});
    frame.loads.push_back({node, Component::y, {{0.0, turned.y()}}});
    frame.loads.push_back({node, Component::rotation, {{0.0, sense() * force_ * view_.length * moment}}});
  }

  void line_load(int beam, const Vector2& load) {
    const Vector2 turned = force_ / view_.length * view_.turned(load);
    frame.distributed_loads.push_back({beam, {{0.0, turned.x()}}, {{0.0, turned.y()}}});
  }

  void gravity(const Vector2& gravity) {
    const Vector2 turned = view_.length / (view_.time * view_.time) * view_.turned(gravity) * kMetres;
    frame.gravity_x_m_per_s2 = turned.x();
    frame.gravity_y_m_per_s2 = turned.y();
  }

  /// Factor of the density.
  [[nodiscard]] double density() const { return view_.stress * std::pow(view_.time / view_.length, 2); }

  FrameLattice frame;

 private:
  [[nodiscard]] double sense() const { return view_.mirrored ? -1.0 : 1.0; }

  const View& view_;
  double force_;
};

void renumber(const View& view, FrameLattice& frame) {
  const auto rename = [&](auto& items) {
    for (auto& item : items) item.node = view.node(item.node);
    std::ranges::reverse(items);
  };
  std::ranges::reverse(frame.nodes);
  rename(frame.supports);
  rename(frame.loads);
  rename(frame.motions);
  rename(frame.initial_velocities);
  constexpr std::array kOrder = {3, 0, 5, 2, 4, 6, 1};  // the beam that comes to each place
  const std::vector<FrameLattice::Beam> beams = frame.beams;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    FrameLattice::Beam& beam = frame.beams[i];
    beam = beams[kOrder[i]];
    beam.start = view.node(beam.start);
    beam.end = view.node(beam.end);
    if (i % 2 == 0) std::swap(beam.start, beam.end);
  }
  for (FrameLattice::DistributedLoad& load : frame.distributed_loads) {
    load.beam = static_cast<int>(std::ranges::find(kOrder, load.beam) - kOrder.begin());
  }
}

}  // namespace

Vector2 View::turned(const Vector2& vector) const {
  const double x = mirrored ? -vector.x() : vector.x();
  return {std::cos(angle) * x - std::sin(angle) * vector.y(), std::sin(angle) * x + std::cos(angle) * vector.y()};
}

int View::node(int number) const { return renumbered ? StruckFrame::kNodes - 1 - number : number; }

SceneSpec StruckFrame::spec(const View& view) {
  FrameWriter writer(view);
  constexpr std::array<std::array<double, 3>, kNodes> kPlaces = {{{0.0, 0.0, 0.0},
                                                                  {30.0, 2.0, 0.0},
                                                                  {3.0, 25.0, 1e-7},
                                                                  {28.0, 24.0, 0.0},
                                                                  {14.0, 45.0, 0.0},
                                                                  {10.0, 12.0, 0.0},
                                                                  {15.0, 13.5, 0.0},
                                                                  {20.0, 15.0, 0.0}}};
  for (const auto& [x, y, mass] : kPlaces) writer.node(x, y, mass);
  writer.beam(0, 2, 1.0, 4);
  writer.beam(1, 3, 1.0, 3);
  writer.beam(2, 3, 1.0, 4);
  writer.beam(2, kTop, 0.8, 2);
  writer.beam(3, kTop, 0.8, 3);
  writer.beam(kBar, kBar + 1, 1.2, 1);
  writer.beam(kBar + 1, kBar + 2, 1.2, 1);
  writer.moved_node(0, {0.0, 0.0}, true);
  writer.moved_node(1, {0.0, 0.0}, true);
  writer.moved_node(kTop, {2.0, -9.0}, false);
  for (int i = 0; i < kBar; ++i) writer.velocity(i, {0.0, 0.0}, 0.0);
  for (int i = 0; i < 3; ++i) writer.velocity(kBar + i, {55e3 - 600.0 * i, 21e3 + 2000.0 * i}, 400.0);
  writer.load(3, {4.0, -2.0}, 15.0);
  writer.line_load(2, {0.05, -0.1});
  writer.gravity({2e5, -4e6});
  FrameLattice frame = std::move(writer.frame);
  frame.self_contact = true;
  frame.end_time_s = kEnd * view.time;
  if (view.renumbered) renumber(view, frame);
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.depth_mm = 2.0 * view.length;
  spec.material.youngs_modulus_mpa = 70000.0 * view.stress;
  spec.material.yield_stress_mpa = 90.0 * view.stress;
  spec.material.hardening_modulus_mpa = 900.0 * view.stress;
  spec.material.isotropic_fraction = 0.4;
  spec.material.density_kg_per_m3 = kDensity * writer.density();
  spec.contact.friction = 0.3;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  return spec;
}

std::shared_ptr<Scene> StruckFrame::scene(const View& view) { return build(spec(view)); }

}  // namespace cellcrush::scenes
