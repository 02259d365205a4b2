// Two plastic half rings that slide past each other (Neto, Oliveira, Menezes, Alves 2016, CMAME 299, 283-315): contact,
// friction, hardening and bending in plane strain, with elements from 2.2 times as long as the wall is thick down to a
// third of it. Their solids have the greatest force across 35.7 N without friction, 39.0 N with a coefficient of 0.3.
// Of the error of a coarse mesh, the part of contact forces between nodes has a closed form: that of a pressed beam.
// Blind to: inertia, and friction that holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

constexpr double kThickness = 2.0;  // mm
constexpr double kTravel = 31.5;

/// How the arches are drawn and divided.
struct Mesh {
  int chords = 0;  ///< of half a ring
  int elements_of_chord = 1;
};

/// Adds half a ring about a centre; returns its first node. `side`: 1 for an arch upwards.
int add_arch(FrameLattice& frame, const Vector2& centre, double radius, double side, const Mesh& mesh) {
  const int first = static_cast<int>(frame.nodes.size());
  for (int i = 0; i <= mesh.chords; ++i) {
    const double angle = std::numbers::pi * i / mesh.chords;
    frame.nodes.push_back(
        {centre.x() - radius * std::cos(angle), centre.y() + side * radius * std::sin(angle), 0.0, 0.0});
  }
  for (int i = 0; i < mesh.chords; ++i) {
    frame.beams.push_back(scenes::beam(first + i, first + i + 1, kThickness, mesh.elements_of_chord));
  }
  return first;
}

/// The upper arch is moved along x over the lower one, whose feet are held.
SceneSpec arches(const Mesh& mesh, double friction, double duration) {
  FrameLattice frame;
  const int lower = add_arch(frame, {12.0, 0.0}, 11.0, 1.0, mesh);
  const int upper = add_arch(frame, {-1.98, 17.0}, 9.0, -1.0, mesh);
  frame.self_contact = true;
  for (const int foot : {lower, lower + mesh.chords}) frame.supports.push_back({foot, true, true, true});
  for (const int end : {upper, upper + mesh.chords}) {
    frame.supports.push_back({end, false, true, true});
    frame.motions.push_back({end, FrameLattice::Component::x, {{0.0, 0.0}, {duration, kTravel}}});
  }
  frame.watched_nodes = {lower, lower + mesh.chords};
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
  double made = 0.0;      ///< energy that contacts have made, of the work at the end
};

Slide slide(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  Slide result;
  scenes::watch(simulation, [&](const Sample& sample) {
    result.force = std::max(result.force, sample.watched[0].reaction_y + sample.watched[1].reaction_y);
    result.work = sample.energies.external;
    result.made = -sample.energies.contact / sample.energies.external;
    result.residual = std::abs(sample.energies.residual) / sample.energies.external;
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return result;
}

TEST(SlidingArches, OfShortElementsBearWhatThoseOfLongOnesDo) {
  const double coarse = slide(arches({16}, 0.0, 0.05)).force;
  const Slide fine = slide(arches({32}, 0.0, 0.05));
  EXPECT_NEAR(fine.force, coarse, 0.05 * coarse);
  scenes::record_figure("force over that of solids", fine.force / 35.7, 3, {1.0, 0.05});
  scenes::record_bound("residual in %", 100.0 * fine.residual, 0.05);
}

/// By how much the greatest of some values is above the least, %.
double spread(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return 100.0 * (most / least - 1.0);
}

// Moments at the nodes alone, without segments that bend, make energy of 10 % of the work with 16 elements (E8e).
TEST(SlidingArches, AgreeFrom16To48ElementsAndWithSolids) {
  for (const auto& [friction, solids] : {std::pair(0.0, 35.7), {0.3, 39.0}}) {
    std::vector<double> works;
    std::vector<double> forces;
    double residual = 0.0;
    double made = 0.0;
    for (const int chords : {16, 24, 32, 48}) {
      const Slide arch = slide(arches({chords}, friction, 0.2));
      works.push_back(arch.work);
      forces.push_back(arch.force);
      residual = std::max(residual, arch.residual);
      made = std::max(made, arch.made);
    }
    const std::string with = friction == 0.0 ? " without friction" : " with friction";
    scenes::record_bound("difference of works in %" + with, spread(works), 5.0);
    scenes::record_bound("difference of forces in %" + with, spread(forces), 5.0);
    scenes::record_figure("greatest force over that of solids" + with, std::ranges::max(forces) / solids, 3,
                          {1.0, 0.08});
    scenes::record_bound("residual in %" + with, 100.0 * residual, 0.05);
    scenes::record_bound("energy made by contacts in %" + with, 100.0 * made, 0.5);
  }
}

// Drawn as 16 chords, with elements no longer than those of 48 chords: what is left is the error of the drawing.
TEST(SlidingArches, AgreeWhenDrawnAs16ChordsOfThreeElements) {
  for (const double friction : {0.0, 0.3}) {
    const Slide fine = slide(arches({48}, friction, 0.05));
    const Slide drawn = slide(arches({16, 3}, friction, 0.05));
    const std::string with = friction == 0.0 ? " without friction" : " with friction";
    scenes::record_bound("difference of forces in %" + with, spread({drawn.force, fine.force}), 5.0);
    scenes::record_bound("residual in %" + with, 100.0 * drawn.residual, 0.05);
  }
}

// Friction that turns the arches ever more: the ledger stays closed on short elements.
TEST(SlidingArches, KeepTheirLedgerClosedUnderGreatFriction) {
  double residual = 0.0;
  for (const int chords : {32, 48}) residual = std::max(residual, slide(arches({chords}, 0.6, 0.05)).residual);
  scenes::record_bound("residual in %", 100.0 * residual, 0.1);
}

constexpr double kLength = 40.0;  // mm, of the clamped beam
constexpr double kHeight = 1.0;

/// Limit load of a clamped beam of so many elements, over 8 M_p / L. The round end of another beam presses on its
/// middle: on a node if the number is even. One end may move along the beam, so that it bears no axial force.
double limit_load(int elements) {
  constexpr double kYieldStress = 100.0;  // MPa
  constexpr double kPush = 0.5;           // mm, 5 times the elastic deflection at the limit load
  constexpr double kDuration = 0.01;      // s, about 30 periods of the beam
  FrameLattice frame;
  for (int i = 0; i <= elements; ++i) frame.nodes.push_back({kLength * i / elements, 0.0, 0.0, 0.0});
  for (int i = 0; i < elements; ++i) frame.beams.push_back(scenes::beam(i, i + 1, kHeight, 1));
  const int tip = elements + 1;
  frame.nodes.push_back({0.5 * kLength, kHeight + 0.001, 0.0, 0.0});
  frame.nodes.push_back({0.5 * kLength, kHeight + 10.0, 0.0, 0.0});
  frame.beams.push_back(scenes::beam(tip, tip + 1, kHeight, 1));
  frame.self_contact = true;
  frame.supports = {{0, true, true, true}, {elements, false, true, true}};
  for (const int node : {tip, tip + 1}) {
    frame.supports.push_back({node, true, false, true});
    frame.motions.push_back({node, FrameLattice::Component::y, {{0.0, 0.0}, {kDuration, -kPush}}});
  }
  frame.watched_nodes = {0, elements};
  frame.end_time_s = kDuration;
  SceneSpec spec = scenes::plastic_frame(frame, 200000.0, kYieldStress);
  spec.numerics.mass_damping_per_s = 4000.0;
  Simulation simulation(scenes::build(spec));
  double force = 0.0;
  scenes::watch(simulation,
                [&](const Sample& sample) { force = sample.watched[0].reaction_y + sample.watched[1].reaction_y; });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return force / (8.0 * 0.25 * kYieldStress * kHeight * kHeight / kLength);
}

// The nodes share the force of a contact by the lever rule. In the middle of an element of length l the moment then
// lacks f l / 4, of which the nodes bear half, up to that of an element as long as the beam is thick (E8e).
TEST(LoadBetweenNodes, RaisesTheLimitLoadByPartOfTheLengthOfAnElement) {
  for (const int elements : {5, 9, 17, 41}) {
    const double length = kLength / elements;
    const double span = kLength - length + 0.5 * std::min(length, kHeight);
    scenes::record_figure(std::to_string(elements) + " elements", limit_load(elements), 3, {kLength / span, 0.008});
  }
  scenes::record_figure("8 elements: at a node", limit_load(8), 3, {1.0, 0.015});
}

}  // namespace
}  // namespace cellcrush
