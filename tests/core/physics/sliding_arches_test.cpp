// Two plastic half rings that slide past each other (Neto, Oliveira, Menezes, Alves 2016, CMAME 299, 283-315): contact,
// friction, hardening and bending in plane strain, with elements from 2.2 times as long as the wall is thick down to a
// third of it. Their solids have the greatest force across 35.7 N without friction, 39.0 N with a coefficient of 0.3.
// Blind to: inertia, and friction that holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

constexpr double kThickness = 2.0;  // mm
constexpr double kTravel = 31.5;

/// Adds half a ring of so many beams about a centre; returns its first node. `side`: 1 for an arch upwards.
int add_arch(FrameLattice& frame, const Vector2& centre, double radius, double side, int beams) {
  const int first = static_cast<int>(frame.nodes.size());
  for (int i = 0; i <= beams; ++i) {
    const double angle = std::numbers::pi * i / beams;
    frame.nodes.push_back(
        {centre.x() - radius * std::cos(angle), centre.y() + side * radius * std::sin(angle), 0.0, 0.0});
  }
  for (int i = 0; i < beams; ++i) frame.beams.push_back(scenes::beam(first + i, first + i + 1, kThickness, 1));
  return first;
}

/// The upper arch is moved along x over the lower one, whose feet are held.
SceneSpec arches(int beams, double friction, double duration) {
  FrameLattice frame;
  const int lower = add_arch(frame, {12.0, 0.0}, 11.0, 1.0, beams);
  const int upper = add_arch(frame, {-1.98, 17.0}, 9.0, -1.0, beams);
  frame.self_contact = true;
  for (const int foot : {lower, lower + beams}) frame.supports.push_back({foot, true, true, true});
  for (const int end : {upper, upper + beams}) {
    frame.supports.push_back({end, false, true, true});
    frame.motions.push_back({end, FrameLattice::Component::x, {{0.0, 0.0}, {duration, kTravel}}});
  }
  frame.watched_nodes = {lower, lower + beams};
  frame.end_time_s = duration;
  SceneSpec spec = scenes::plastic_frame(frame, 689.56, 31.0, 1000.0);
  spec.material.plane = MaterialSpec::Plane::strain;
  spec.material.poissons_ratio = 0.32;
  spec.material.hardening_modulus_mpa = 261.2;
  spec.contact.friction = friction;
  return spec;
}

struct Slide {
  double force = 0.0;     ///< N, the greatest across the motion on the lower feet
  double work = 0.0;      ///< N mm, of the motion
  double residual = 0.0;  ///< of the work at the end
};

Slide slide(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  Slide result;
  scenes::watch(simulation, [&](const Sample& sample) {
    result.force = std::max(result.force, sample.watched[0].reaction_y + sample.watched[1].reaction_y);
    result.work = sample.energies.external;
    result.residual = std::abs(sample.energies.residual) / sample.energies.external;
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return result;
}

TEST(SlidingArches, OfShortElementsBearWhatThoseOfLongOnesDo) {
  const double coarse = slide(arches(16, 0.0, 0.05)).force;
  const Slide fine = slide(arches(32, 0.0, 0.05));
  EXPECT_NEAR(fine.force, coarse, 0.05 * coarse);
  scenes::record_figure("force over that of solids", fine.force / 35.7, 3, {1.0, 0.05});
  scenes::record_bound("residual in %", 100.0 * fine.residual, 0.05);
}

/// By how much the greatest of some values is above the least, %.
double spread(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return 100.0 * (most / least - 1.0);
}

// With 16 elements the greatest force under friction is a few percent higher: that is the error of a coarse mesh.
TEST(SlidingArches, AgreeFrom16To48ElementsAndWithSolids) {
  for (const auto& [friction, solids] : {std::pair(0.0, 35.7), {0.3, 39.0}}) {
    std::vector<double> works;
    std::vector<double> forces;
    double residual = 0.0;
    for (const int beams : {16, 24, 32, 48}) {
      const Slide arch = slide(arches(beams, friction, 0.2));
      works.push_back(arch.work);
      forces.push_back(arch.force);
      residual = std::max(residual, arch.residual);
    }
    const std::string with = friction == 0.0 ? " without friction" : " with friction";
    scenes::record_bound("difference of works in %" + with, spread(works), 5.0);
    scenes::record_bound("difference of forces in %" + with, spread(forces), 7.0);
    const std::vector<double> of_fine(forces.begin() + 1, forces.end());
    scenes::record_bound("difference of forces of 24 to 48 in %" + with, spread(of_fine), 5.0);
    scenes::record_figure("greatest force over that of solids" + with, std::ranges::max(forces) / solids, 3,
                          {1.0, 0.08});
    scenes::record_bound("residual in %" + with, 100.0 * residual, 0.05);
  }
}

// Friction that turns the arches ever more: the ledger stays closed on short elements.
TEST(SlidingArches, KeepTheirLedgerClosedUnderGreatFriction) {
  double residual = 0.0;
  for (const int beams : {32, 48}) residual = std::max(residual, slide(arches(beams, 0.6, 0.05)).residual);
  scenes::record_bound("residual in %", 100.0 * residual, 0.1);
}

}  // namespace
}  // namespace cellcrush
