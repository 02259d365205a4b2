// Walls that are shorter than their thickness: what they cost as beams, and that as rigid links (E13) they cost nothing
// and change nothing.
#include "scene/rigid_links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "cellcrush/spec_checker.h"
#include "cellcrush/state.h"
#include "scene/slowest_wall.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/voronoi.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kStub = 0.02;  // mm

const Vector2 kFarAway(1e9, 1e9);

SceneSpec listed_hexagons() {
  SceneSpec spec = scenes::listed(scenes::hexagon_specimen(8, 7));
  spec.loading.speed_m_per_s = 100.0;
  return spec;
}

FrameWalls& listed_walls(SceneSpec& spec) { return std::get<FrameWalls>(spec.lattice); }

Vector2 place_of_node(const FrameWalls& frame, int node) { return {frame.nodes[node].x_mm, frame.nodes[node].y_mm}; }

/// A joint of three walls in the middle of a frame.
int joint_in_the_middle(const FrameWalls& frame) {
  Vector2 centre = Vector2::Zero();
  std::vector<int> walls(frame.nodes.size(), 0);
  for (const FrameWalls::Beam& beam : frame.beams) {
    ++walls[beam.start];
    ++walls[beam.end];
  }
  for (int node = 0; node < static_cast<int>(frame.nodes.size()); ++node) {
    centre += place_of_node(frame, node) / static_cast<double>(frame.nodes.size());
  }
  int nearest = 0;
  Vector2 best = kFarAway;
  for (int node = 0; node < static_cast<int>(frame.nodes.size()); ++node) {
    if (walls[node] == 3 && (place_of_node(frame, node) - centre).norm() < (best - centre).norm()) {
      nearest = node;
      best = place_of_node(frame, node);
    }
  }
  return nearest;
}

/// Splits off a short beam from a long one that ends at a node: the lattice keeps its shape. Returns its index.
int add_stub(SceneSpec& spec, int node, double length) {
  FrameWalls& frame = listed_walls(spec);
  const auto wall = std::ranges::find_if(frame.beams, [&](const FrameWalls::Beam& beam) {
    const double long_enough = 5.0 * std::max(length, beam.thickness_mm);
    return (beam.start == node || beam.end == node) &&
           (place_of_node(frame, beam.end) - place_of_node(frame, beam.start)).norm() > long_enough;
  });
  int& end = wall->start == node ? wall->start : wall->end;
  const int other = wall->start == node ? wall->end : wall->start;
  const Vector2 along = (place_of_node(frame, other) - place_of_node(frame, node)).normalized();
  const Vector2 place = place_of_node(frame, node) + length * along;
  end = static_cast<int>(frame.nodes.size());
  frame.nodes.push_back({place.x(), place.y(), 0.0, 0.0});
  FrameWalls::Beam stub = *wall;
  stub.start = node;
  stub.end = end;
  const int index = static_cast<int>(frame.beams.size()) / 2;
  frame.beams.insert(frame.beams.begin() + index, stub);
  return index;
}

struct Stubbed {
  SceneSpec spec;
  int beam = 0;
};

Stubbed hexagons_with_stub(double slenderness = 1.0, double length = kStub) {
  Stubbed made = {listed_hexagons()};
  made.beam = add_stub(made.spec, joint_in_the_middle(listed_walls(made.spec)), length);
  made.spec.numerics.rigid_link_slenderness = slenderness;
  return made;
}

std::string beam_text(int beam) { return "lattice.frame.beams[" + std::to_string(beam) + "]"; }

TEST(RigidLinks, LeaveTheStepOfTheOtherWalls) {
  const auto without = scenes::build(listed_hexagons());
  const auto as_beam = scenes::build(hexagons_with_stub(0.0).spec);
  const auto as_link = scenes::build(hexagons_with_stub().spec);
  EXPECT_LT(as_beam->schedule.time_step, without->schedule.time_step / 1000.0);
  EXPECT_NEAR(as_link->schedule.time_step, without->schedule.time_step, 0.01 * without->schedule.time_step);
  scenes::record_figure("step over that as a beam", as_link->schedule.time_step / as_beam->schedule.time_step, 2);
  EXPECT_EQ(as_link->rigid.count(), 1u);
  EXPECT_NEAR(as_link->total_mass, as_beam->total_mass, 1e-12 * as_beam->total_mass);
  EXPECT_NEAR(as_link->total_mass, without->total_mass, 1e-12 * without->total_mass);
  double lumped = 0.0;
  for (const double mass : as_link->mass) lumped += mass;
  EXPECT_NEAR(lumped, as_link->total_mass, 1e-12 * lumped);  // no mass is added
}

TEST(RigidLinks, AreToldWithTheWallThatSetsTheStep) {
  const Stubbed as_beam = hexagons_with_stub(0.0);
  const auto beam_scene = scenes::build(as_beam.spec);
  EXPECT_THAT(facts_of(*beam_scene).modelled,
              Contains(::testing::AllOf(HasSubstr("in a wall 0.02 mm long"), HasSubstr("times as long"))));
  const Problems notes = find_costly_walls(as_beam.spec, *beam_scene);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].field, beam_text(as_beam.beam));
  EXPECT_EQ(notes[0].value, "0.02 mm");
  EXPECT_THAT(notes[0].remedy, HasSubstr("numerics.rigid_link_slenderness"));
  const Stubbed as_link = hexagons_with_stub();
  const auto link_scene = scenes::build(as_link.spec);
  EXPECT_TRUE(find_costly_walls(as_link.spec, *link_scene).empty());
  EXPECT_THAT(facts_of(*link_scene).modelled, Contains(HasSubstr("Rigid links: 1 wall")));
  EXPECT_THAT(facts_of(*scenes::build(listed_hexagons())).modelled, Not(Contains(HasSubstr("Rigid links"))));
}

/// A network with a stub at the first joint.
SceneSpec network_with_stub() {
  SceneSpec spec = scenes::as_network(scenes::hexagon_specimen(8, 7));
  spec.loading.speed_m_per_s = 100.0;
  auto& network = std::get<NetworkWalls>(spec.lattice);
  const int start = network.walls[0];
  const auto joint = static_cast<int>(network.joint_count());
  const Vector2 place(network.joints_mm[2 * start], network.joints_mm[2 * start + 1]);
  const Vector2 other(network.joints_mm[2 * network.walls[1]], network.joints_mm[2 * network.walls[1] + 1]);
  const Vector2 split = place + kStub * (other - place).normalized();
  network.joints_mm.insert(network.joints_mm.end(), {split.x(), split.y()});
  network.walls[0] = joint;
  network.walls.insert(network.walls.end(), {start, joint});
  network.thicknesses_mm.push_back(network.thicknesses_mm.front());
  return spec;
}

TEST(RigidLinks, AreMadeOfANetworksShortWalls) {
  SceneSpec spec = network_with_stub();
  const auto as_link = scenes::build(spec);
  EXPECT_EQ(as_link->rigid.links, 1u);
  EXPECT_TRUE(find_costly_walls(spec, *as_link).empty());
  const double plain = scenes::build(scenes::as_network(scenes::hexagon_specimen(8, 7)))->stable_step;
  EXPECT_NEAR(as_link->stable_step / plain, 1.0, 0.05);
  // The last of the list is the last element.
  const auto listed = static_cast<int>(std::get<NetworkWalls>(spec.lattice).wall_count());
  EXPECT_EQ(listed_wall_of(*as_link, static_cast<int>(as_link->element_count()) - 1), listed - 1);
  spec.numerics.rigid_link_slenderness = 0.0;
  const auto as_beam = scenes::build(spec);
  EXPECT_LT(as_beam->stable_step, 1e-2 * as_link->stable_step);
  const Problems notes = find_costly_walls(spec, *as_beam);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].field, "lattice.network.walls");
  EXPECT_EQ(notes[0].value, "0.02 mm");
  EXPECT_THAT(notes[0].remedy, HasSubstr("numerics.rigid_link_slenderness"));
}

/// The work of the plate and the plateau stress up to a strain.
struct Outcome {
  double work = 0.0;
  double ledger = 0.0;
  double support_impulse = 0.0;
  double momentum_error = 0.0;
};

Outcome outcome_of(SceneSpec spec, double end_strain) {
  spec.loading.end_strain = end_strain;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const Sample last = scenes::run_to_end(simulation).back();
  const State& state = simulation.state();
  const double impulse = state.impact_impulse - state.support_impulse;
  const double momentum = scenes::momentum_of(*scene, state).linear[scene->plates.axis];
  return {last.energies.external, std::abs(last.energies.residual) / last.energies.external, state.support_impulse,
          std::abs(momentum - impulse) / state.impact_impulse};
}

TEST(RigidLinks, CrushAsTheLatticeWithoutThem) {
  const Outcome without = outcome_of(listed_hexagons(), 0.5);
  const Outcome with = outcome_of(hexagons_with_stub().spec, 0.5);
  scenes::record_bound("difference of the work in %", 100.0 * std::abs(with.work / without.work - 1.0), 1.0);
  EXPECT_NEAR(with.support_impulse / without.support_impulse, 1.0, 0.03);
  EXPECT_LT(with.ledger, 0.006);
  EXPECT_LT(with.momentum_error, 1e-2);
}

// As beams a longer stub is run, for its steps are short; over a short time, in which the front passes it.
TEST(RigidLinks, CrushAsTheSameBeams) {
  const double stub = 0.15;
  const Outcome as_beam = outcome_of(hexagons_with_stub(0.0, stub).spec, 0.3);
  const Outcome as_link = outcome_of(hexagons_with_stub(1.0, stub).spec, 0.3);
  scenes::record_bound("difference of the work in %", 100.0 * std::abs(as_link.work / as_beam.work - 1.0), 1.0);
  EXPECT_NEAR(as_link.support_impulse / as_beam.support_impulse, 1.0, 0.03);
  EXPECT_LT(as_link.ledger, 0.006);
}

/// A raw foam of 60 cells and a relative density of 0.1 between the plates.
SceneSpec foam(double slenderness, std::uint64_t seed) {
  SceneSpec spec = scenes::hexagon_specimen(8, 7);
  spec.imperfection = {};
  spec.lattice = scenes::voronoi_foam(40.0, 30.0, 60, 0.1, seed);
  spec.loading.speed_m_per_s = 100.0;
  spec.numerics.rigid_link_slenderness = slenderness;
  return spec;
}

TEST(RigidLinks, LengthenTheStepOfRawFoams) {
  std::vector<double> gains;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto as_beams = scenes::build(foam(0.0, seed));
    const auto as_links = scenes::build(foam(1.0, seed));
    gains.push_back(as_links->schedule.time_step / as_beams->schedule.time_step);
    EXPECT_GT(gains.back(), 1.5) << seed;
    EXPECT_LT(slowest_wall_of(*as_links).cost, 100.0) << seed;  // of 1.2e6 as beams
    EXPECT_LE(link_mass_share_of(*as_links), kMostLinkMass) << seed;
    EXPECT_NEAR(as_links->total_mass, as_beams->total_mass, 1e-12 * as_beams->total_mass) << seed;
  }
  std::ranges::sort(gains);
  scenes::record_figure("least step over that as beams", gains.front(), 2);
  scenes::record_figure("median step over that as beams", 0.5 * (gains[5] + gains[6]), 2);
  scenes::record_figure("greatest step over that as beams", gains.back(), 2);
}

TEST(RigidLinks, CrushAFoamAsItsBeams) {
  const SceneSpec spec = foam(1.0, 1);
  const auto scene = scenes::build(spec);
  EXPECT_EQ(scene->element_count() - scene->rigid.first_element, 6u);
  const Outcome as_beams = outcome_of(foam(0.0, 1), 0.3);
  const Outcome as_links = outcome_of(spec, 0.3);
  scenes::record_bound("difference of the work in %", 100.0 * std::abs(as_links.work / as_beams.work - 1.0), 2.0);
  EXPECT_NEAR(as_links.support_impulse / as_beams.support_impulse, 1.0, 0.03);
  EXPECT_LT(as_links.ledger, 0.006);
  EXPECT_LT(as_links.momentum_error, 1e-9);
}

TEST(RigidLinks, OfAFoamAreThoseOfItsFrame) {
  const SceneSpec frame = foam(1.0, 1);
  const auto of_frame = scenes::build(frame);
  const auto of_network = scenes::build(scenes::as_network(frame));
  EXPECT_EQ(of_network->rigid.links, of_frame->rigid.links);
  EXPECT_EQ(of_network->rigid.offset, of_frame->rigid.offset);
  const auto links_of = [](const Scene& scene) {
    return std::set(scene.list_order.wall.end() - static_cast<std::ptrdiff_t>(scene.rigid.links),
                    scene.list_order.wall.end());
  };
  EXPECT_EQ(links_of(*of_network), links_of(*of_frame));
  // A beam of a frame has two elements however short it is.
  EXPECT_GT(of_network->stable_step, 1.9 * of_frame->stable_step);
}

TEST(RigidLinks, AreNotMadeOfBeamsThatAreHeldLoadedOrManyInARow) {
  const auto links_of = [](const SceneSpec& spec) { return scenes::build(spec)->rigid.count(); };
  const auto made = [] { return hexagons_with_stub(); };
  Stubbed held = made();
  listed_walls(held.spec).supports.push_back({listed_walls(held.spec).beams[held.beam].end, false, false, true});
  EXPECT_EQ(links_of(held.spec), 0u);
  Stubbed loaded = made();
  loaded.spec.loads.distributed_loads.push_back({loaded.beam, {{0.0, 0.001}}, {}});
  EXPECT_EQ(links_of(loaded.spec), 0u);
  const double thickness = listed_walls(held.spec).beams[held.beam].thickness_mm;
  Stubbed in_a_row = hexagons_with_stub(1.0, 0.3 * thickness);
  int last = listed_walls(in_a_row.spec).beams[in_a_row.beam].end;
  for (int i = 0; i < 5; ++i) {
    last = listed_walls(in_a_row.spec).beams[add_stub(in_a_row.spec, last, 0.3 * thickness)].end;
  }
  EXPECT_EQ(links_of(in_a_row.spec), 0u);
  // Where it is shorter than half of the others, it alone is a link.
  Stubbed of_two_lengths = hexagons_with_stub();
  last = listed_walls(of_two_lengths.spec).beams[of_two_lengths.beam].end;
  for (int i = 0; i < 3; ++i) {
    last = listed_walls(of_two_lengths.spec).beams[add_stub(of_two_lengths.spec, last, 0.6 * thickness)].end;
  }
  EXPECT_EQ(put_rigid_links_first(of_two_lengths.spec).links, 1);
  SceneSpec many = listed_hexagons();
  const int nodes = static_cast<int>(listed_walls(many).nodes.size());
  for (int node = 0; node < nodes; node += 4) add_stub(many, node, 0.9 * thickness);
  const auto scene = scenes::build(many);
  EXPECT_EQ(scene->rigid.count(), 0u);
  const Problems notes = find_costly_walls(many, *scene);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].remedy, HasSubstr("all of them have more than 1 % of the mass"));
}

// Nodes and beams keep their names though links are numbered first.
TEST(RigidLinks, LeaveNamesOfNodesAndBeams) {
  Stubbed made = hexagons_with_stub();
  FrameWalls& frame = listed_walls(made.spec);
  for (int node = 0; node < static_cast<int>(frame.nodes.size()); ++node) frame.watched_nodes.push_back(node);
  const auto scene = scenes::build(made.spec);
  ASSERT_EQ(scene->watched.size(), frame.nodes.size());
  for (std::size_t node = 0; node < frame.nodes.size(); ++node) {
    EXPECT_EQ(scene->position[scene->watched[node]], place_of_node(frame, static_cast<int>(node)));
    EXPECT_EQ(scene->list_order.listed_joint(scene->watched[node]), static_cast<int>(node));
  }
  std::vector<int> beams = scene->list_order.wall;
  EXPECT_EQ(beams.back(), made.beam);
  std::ranges::sort(beams);
  for (std::size_t beam = 0; beam < frame.beams.size(); ++beam) EXPECT_EQ(beams[beam], static_cast<int>(beam));
  const MeshView mesh = mesh_of(*scene);
  EXPECT_EQ(mesh.rigid_elements, 1);
  for (std::size_t element = 0; element < mesh.element_wall.size(); ++element) {
    const FrameWalls::Beam& beam = frame.beams[mesh.element_wall[element]];
    const Vector2 start = place_of_node(frame, beam.start);
    const Vector2 end = place_of_node(frame, beam.end);
    const Vector2& place = scene->position[scene->elements[element].start];
    EXPECT_NEAR((place - start).norm() + (place - end).norm(), (end - start).norm(), 1e-6) << element;
  }
}

TEST(RigidLinks, HaveNoStrainUnderTheirOwnNumbers) {
  Stubbed made = hexagons_with_stub();
  made.spec.loading.end_strain = 0.1;
  const auto scene = scenes::build(made.spec);
  Simulation simulation(scene);
  const Sample last = scenes::run_to_end(simulation).back();
  const FieldFrame fields = simulation.take_frame(1);
  ASSERT_EQ(fields.fibre_strain.size(), listed_walls(made.spec).beams.size());
  EXPECT_EQ(std::ranges::count(fields.fibre_strain, 0.0F), 1);
  EXPECT_EQ(fields.fibre_strain[made.beam], 0.0F);
  EXPECT_EQ(fields.fibre_strain[last.most_strained_wall], std::ranges::max(fields.fibre_strain));
  const auto summary = summarize(*scene, {&last, 1});
  ASSERT_TRUE(summary.fibre_strain);
  EXPECT_EQ(summary.rigid_link_count, 1);
  const FrameWalls::Beam& beam = listed_walls(made.spec).beams[summary.fibre_strain->wall];
  const Vector2 middle =
      0.5 * (place_of_node(listed_walls(made.spec), beam.start) + place_of_node(listed_walls(made.spec), beam.end));
  EXPECT_NEAR((middle - Vector2(summary.fibre_strain->x, summary.fibre_strain->y)).norm(), 0.0, 1e-9);
}

// A frame that is thrown: links have the velocity of their nodes from the start, and momenta stay.
TEST(RigidLinks, FlyWithTheFrame) {
  Stubbed made = hexagons_with_stub();
  made.spec.loading = {};
  made.spec.loading.end_time_s = 1e-4;
  const int nodes = static_cast<int>(listed_walls(made.spec).nodes.size());
  for (int node = 0; node < nodes; ++node) made.spec.loads.initial_velocities.push_back({node, 3.0, -1.0, 0.0});
  const auto scene = scenes::build(made.spec);
  Simulation simulation(scene);
  const Sample last = scenes::run_to_end(simulation).back();
  const Vector2 momentum = scenes::momentum_of(*scene, simulation.state()).linear;
  EXPECT_NEAR(momentum.x(), 3000.0 * scene->total_mass, 1e-9 * 3000.0 * scene->total_mass);
  EXPECT_NEAR(momentum.y(), -1000.0 * scene->total_mass, 1e-9 * 3000.0 * scene->total_mass);
  EXPECT_LT(last.energies.elastic, 1e-9 * last.energies.kinetic);
}

TEST(RigidLinks, HaveALimitedSlenderness) {
  for (const double wrong : {-1.0, 3.5, std::nan("")}) {
    const SceneResult result = build_scene(hexagons_with_stub(wrong).spec);
    ASSERT_EQ(result.problems.size(), 1u) << wrong;
    EXPECT_EQ(result.problems[0].field, "numerics.rigid_link_slenderness");
    EXPECT_THAT(result.problems[0].remedy, HasSubstr("from 0 to 3"));
  }
}

}  // namespace
}  // namespace cellcrush
