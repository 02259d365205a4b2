#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <map>
#include <type_traits>

#include "drawing/compact_network.h"
#include "programs/text_proto.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "server/brick_network.h"
#include "server/problem_fields.h"
#include "server/small_case.h"
#include "translate/case_checker.h"
#include "translate/case_to_spec.h"
#include "translate/check_case.h"
#include "translate/measured_errors.h"
#include "translate/spec_to_case.h"

namespace cellcrush {
namespace {

using google::protobuf::util::MessageDifferencer;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::fields_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

v1::Case frame_case(const std::string& more = "") {
  v1::Case out = testing::small_case();
  out.clear_loading();
  return testing::with_text(out, R"(lattice { frame {
    nodes { id: "left" x_mm: 0 y_mm: 0 } nodes { id: "right" x_mm: 100 y_mm: 0 }
    beams { start: "left" end: "right" thickness_mm: 1 }
    supports { node: "left" fix_x: true fix_y: true }
    loads { node: "right" component: COMPONENT_Y force_n_or_n_mm { points { time_s: 0.001 value: 5 } } }
    end_time_s: 0.01 )" + more + "} }");
}

TEST(Translate, EveryPresetSurvivesTheWayToTheWireAndBack) {
  for (const auto& preset : scenes::presets()) {
    const v1::Case once = translate::to_case(preset.spec);
    const auto reading = translate::to_spec(once);
    EXPECT_THAT(reading.problems, IsEmpty()) << preset.name;
    const v1::Case twice = translate::to_case(reading.spec);
    EXPECT_TRUE(MessageDifferencer::Equals(once, twice)) << preset.name;
    EXPECT_EQ(reading.spec.loading.speed_m_per_s, preset.spec.loading.speed_m_per_s);
    EXPECT_EQ(reading.spec.lattice.index(), preset.spec.lattice.index());
  }
}

TEST(Translate, APresetWithAnotherFormulationTakesThePointsThatGoWithIt) {
  v1::Case of_preset = translate::to_case(scenes::preset("type-i"));
  EXPECT_EQ(translate::to_spec(of_preset).spec.section.axial_count(), 4);
  of_preset.mutable_section()->set_formulation(v1::Section::DISPLACEMENT_BASED);
  EXPECT_EQ(translate::to_spec(of_preset).spec.section.axial_count(), 2);
}

TEST(Translate, AnEmptyCaseTakesTheSpecsDefaultsAndInventsNothing) {
  const auto reading = translate::to_spec(v1::Case());
  EXPECT_THAT(reading.problems, IsEmpty());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(reading.spec.lattice));
  EXPECT_FALSE(reading.spec.depth_mm);
  EXPECT_FALSE(reading.spec.material.youngs_modulus_mpa);
  EXPECT_FALSE(reading.spec.loading.speed_m_per_s);
  EXPECT_EQ(reading.spec.loading.end_strain, LoadingSpec().end_strain);
  EXPECT_EQ(reading.spec.contact.damping_ratio, ContactSpec().damping_ratio);
}

TEST(Translate, ZeroIsNotLeftOut) {
  v1::Case given;
  given.mutable_contact()->set_damping_ratio(0.0);
  given.mutable_contact()->set_impact_speed_m_per_s(400.0);
  given.mutable_loading()->set_speed_m_per_s(0.0);
  const auto reading = translate::to_spec(given);
  EXPECT_EQ(reading.spec.contact.damping_ratio, 0.0);
  EXPECT_EQ(reading.spec.contact.impact_speed_m_per_s, 400.0);
  EXPECT_EQ(reading.spec.loading.speed_m_per_s, 0.0);
}

TEST(Translate, TheSearchOfContactsIsByFacesUnlessBucketsAreAskedFor) {
  v1::Case given;
  EXPECT_EQ(translate::to_spec(given).spec.contact.search, ContactSpec::Search::faces);
  given.mutable_contact()->set_search(v1::Contact::BUCKETS);
  const auto reading = translate::to_spec(given);
  EXPECT_THAT(reading.problems, IsEmpty());
  EXPECT_EQ(reading.spec.contact.search, ContactSpec::Search::buckets);
  EXPECT_EQ(translate::to_case(reading.spec).contact().search(), v1::Contact::BUCKETS);
}

TEST(Translate, AFidelityGoesBothWaysAndWhatItFillsInStaysLeftOutUntilTheCaseIsCompleted) {
  for (const auto fidelity : {v1::Numerics::DRAFT, v1::Numerics::STANDARD, v1::Numerics::REFERENCE}) {
    v1::Case given = testing::small_case();
    given.mutable_numerics()->set_fidelity(fidelity);
    const v1::Case there_and_back = translate::to_case(translate::to_spec(given).spec);
    EXPECT_EQ(there_and_back.numerics().fidelity(), fidelity);
    EXPECT_FALSE(there_and_back.has_elements_per_wall());
    const v1::Case completed = translate::check_case(given).response.completed_case();
    EXPECT_EQ(completed.numerics().fidelity(), fidelity);
    EXPECT_TRUE(completed.has_elements_per_wall());
  }
}

TEST(Translate, ForecastsAreTimesOfOneCoreAndTheOneAskedForIsThePrediction) {
  constexpr double kStepCost = 1e-7;
  v1::Case given = testing::small_case();
  given.mutable_numerics()->set_fidelity(v1::Numerics::STANDARD);
  auto check = translate::check_case(given);
  translate::add_fidelities(given, kStepCost, check);
  const v1::CheckCaseResponse& response = check.response;
  ASSERT_EQ(response.fidelities_size(), 3);
  const auto& standard = response.fidelities(1);
  EXPECT_EQ(standard.fidelity(), v1::Numerics::STANDARD);
  EXPECT_DOUBLE_EQ(standard.predicted_seconds(), kStepCost * check.reference_steps);
  EXPECT_GT(response.fidelities(2).predicted_seconds(), 4.0 * standard.predicted_seconds()) << "a finer mesh";
  EXPECT_EQ(response.predicted_seconds(), standard.predicted_seconds());
  given.mutable_numerics()->clear_fidelity();
  auto unspecified = translate::check_case(given);
  translate::add_fidelities(given, kStepCost, unspecified);
  EXPECT_EQ(unspecified.response.predicted_seconds(), standard.predicted_seconds());
}

TEST(Translate, UnknownEnumNumbersAndALongTitleAreProblems) {
  v1::Case given = testing::small_case();
  given.mutable_loading()->set_direction(static_cast<v1::Loading::Direction>(17));
  given.mutable_contact()->set_search(static_cast<v1::Contact::Search>(7));
  given.mutable_numerics()->set_fidelity(static_cast<v1::Numerics::Fidelity>(99));
  std::string title;
  for (int i = 0; i < 201; ++i) title += "ü";
  given.set_title(title);
  EXPECT_THAT(fields_of(translate::to_spec(given).problems),
              UnorderedElementsAre("title", "contact.search", "loading.direction", "numerics.fidelity"));
  given.set_title(title.substr(2));
  EXPECT_THAT(fields_of(translate::to_spec(given).problems), Not(Contains("title")));
}

TEST(Translate, AFramesWrongNamesAreProblemsWithTheirPaths) {
  v1::Case given = frame_case();
  auto& frame = *given.mutable_lattice()->mutable_frame();
  frame.mutable_beams(0)->set_end("nowhere");
  frame.mutable_nodes(1)->set_id("left");
  frame.mutable_supports(0)->clear_node();
  EXPECT_THAT(fields_of(translate::to_spec(given).problems),
              ElementsAre("lattice.frame.nodes[1].id", "lattice.frame.beams[0].end", "lattice.frame.supports[0].node",
                          "lattice.frame.loads[0].node"));
}

TEST(Translate, EveryPartOfAFrameComesThroughBothWays) {
  const v1::Case given = frame_case(R"(
    beams { material { density_kg_per_m3: 1 } pin_end: true start: "right" end: "left" thickness_mm: 1 }
    motions { node: "right" component: COMPONENT_X displacement_mm_or_rad { points { time_s: 0.5 value: 2 } } }
    distributed_loads { beam: 1 y_n_per_mm { points { time_s: 0.5 value: 2 } } }
    gravity_y_m_per_s2: -9.81
    watched_nodes: "right"
    rigid_walls { id: "floor" x_mm: 1 y_mm: -2 normal_y: 3 friction: 0.25
                  displacement_mm { points { time_s: 0.5 value: 2 } } })");
  const auto reading = translate::to_spec(given);
  EXPECT_THAT(reading.problems, IsEmpty());
  const auto& spec = std::get<FrameWalls>(reading.spec.lattice);
  const LoadsSpec& loads = reading.spec.loads;
  EXPECT_EQ(spec.beams.at(0).end, 1);
  EXPECT_EQ(loads.loads.at(0).node, 1);
  EXPECT_EQ(loads.loads.at(0).component, LoadsSpec::Component::y);
  EXPECT_EQ(loads.loads.at(0).points.at(0), std::make_pair(0.001, 5.0));
  EXPECT_EQ(loads.motions.at(0).points.at(0), std::make_pair(0.5, 2.0));
  EXPECT_EQ(loads.distributed_loads.at(0).y_points.size(), 1U);
  EXPECT_TRUE(loads.distributed_loads.at(0).x_points.empty());
  EXPECT_EQ(loads.gravity_y_m_per_s2, -9.81);
  EXPECT_EQ(spec.watched_nodes, std::vector<int>{1});
  EXPECT_EQ(spec.beams.at(1).material->density_kg_per_m3, 1.0);
  EXPECT_FALSE(spec.beams.at(1).pin_start);
  EXPECT_TRUE(spec.beams.at(1).pin_end);
  const LoadsSpec::RigidWall floor = {1.0, -2.0, 0.0, 3.0, 0.25, {{0.5, 2.0}}};
  EXPECT_EQ(loads.rigid_walls, std::vector{floor});
  const v1::Case once = translate::to_case(reading.spec);
  EXPECT_TRUE(MessageDifferencer::Equals(once, translate::to_case(translate::to_spec(once).spec)));
}

v1::Case network_case() {
  v1::Case out = testing::small_case();
  return testing::with_text(out, R"(lattice { network {
    joints_mm: [0, 0, 10, 0, 10, 10, 0, 10] walls: [0, 1, 1, 2, 2, 3, 3, 0]
    thicknesses_mm: [0.1, 0.2, 0.1, 0.2] rises_mm: [0, 0, 0, 1]
    materials { youngs_modulus_mpa: 70000 yield_stress_mpa: 100 density_kg_per_m3: 2700 } wall_materials: [0, 0, 1, 0]
  } })");
}

TEST(Translate, ANetworkComesThroughBothWays) {
  const v1::Case given = network_case();
  const auto reading = translate::to_spec(given);
  EXPECT_THAT(reading.problems, IsEmpty());
  const v1::Case back = translate::to_case(reading.spec);
  v1::Lattice::Network expected = given.lattice().network();
  expected.mutable_materials()->CopyFrom(back.lattice().network().materials());  // with its defaults
  EXPECT_TRUE(MessageDifferencer::Equals(back.lattice().network(), expected));
  const auto checked = translate::check_case(given);
  EXPECT_THAT(fields_of(checked.response), IsEmpty());
  EXPECT_EQ(checked.wall_count, 4);
}

// Decimal fractions have no exact double: the compact form gives the very same ones.
TEST(Translate, TheCompactFormOfANetworkIsTheSameNetwork) {
  v1::Case given = testing::brick_network(40, 30);
  v1::Lattice::Network& network = *given.mutable_lattice()->mutable_network();
  for (int wall = 0; wall < network.walls_size() / 2; ++wall) network.add_rises_mm(wall % 2 == 0 ? 0.000123 : -0.01);
  const auto lists = translate::to_spec(given);
  ASSERT_TRUE(drawing::make_compact(network, drawing::Rounding::none));
  EXPECT_EQ(network.joints_mm_size() + network.walls_size() + network.thicknesses_mm_size(), 0);
  EXPECT_EQ(network.compact().steps_per_mm(), 1'000'000);
  const auto compact = translate::to_spec(given);
  EXPECT_THAT(compact.problems, IsEmpty());
  EXPECT_TRUE(compact.spec.lattice == lists.spec.lattice);
  const auto checked = translate::check_case(given);
  EXPECT_THAT(fields_of(checked.response), IsEmpty());
  const auto& completed = checked.response.completed_case().lattice().network();
  EXPECT_EQ(completed.SerializeAsString(), network.SerializeAsString()) << "in the form in which it was given";
}

TEST(Translate, AProblemOfTheCompactFormNamesItsFields) {
  v1::Case given = testing::brick_network(4, 3);
  v1::Lattice::Network& network = *given.mutable_lattice()->mutable_network();
  ASSERT_TRUE(drawing::make_compact(network, drawing::Rounding::none));
  v1::Lattice::Network::Compact& compact = *network.mutable_compact();
  compact.set_wall_differences(0, 2'000'000'000);
  compact.set_wall_differences(1, 2'000'000'000);
  compact.set_thicknesses(2, -3);
  EXPECT_THAT(fields_of(translate::check_case(given).response),
              AllOf(Contains(StartsWith("lattice.network.compact.wall_differences[0]")),
                    Contains("lattice.network.compact.thicknesses[2]")));
  for (const int steps : {-1, 0, 2'000'000'000}) {
    compact.set_steps_per_mm(steps);
    EXPECT_THAT(fields_of(translate::check_case(given).response), Contains("lattice.network.compact.steps_per_mm"));
  }
  compact.clear_steps_per_mm();
  network.add_rises_mm(1.0);
  EXPECT_THAT(fields_of(translate::check_case(given).response),
              AllOf(Contains("lattice.network.compact.steps_per_mm"), Contains("lattice.network.compact")));
  compact.mutable_rises()->Resize(200'001, 0);
  EXPECT_THAT(fields_of(translate::check_case(given).response), ElementsAre("lattice.network.compact.rises"));
}

TEST(Translate, AVoronoiHoneycombAndItsChangesComeThroughBothWays) {
  v1::Case given = testing::small_case();
  given.clear_lattice();
  given = testing::with_text(given, R"(lattice {
    voronoi { columns: 6 rows: 4 side_mm: 4 irregularity: 0.5 relaxation_steps: 2 seed: 18446744073709551615
              relative_density: 0.1 edge_walls: true }
    defects { missing_walls: 0.05 thickness_scatter: 0.1 seed: 3 }
    grading { axis: Y thickness_steps: [1, 2] size_polynomial: [1, 0.5] }
    rotation_degrees: 30
    outline { corners_mm: [5, 5, 30, 18] edge_wall_thickness_mm: 0.2 }
  })");
  const auto reading = translate::to_spec(given);
  EXPECT_THAT(reading.problems, IsEmpty());
  v1::Lattice back = translate::to_case(reading.spec).lattice();
  back.clear_imperfection();
  v1::Lattice expected = given.lattice();
  expected.clear_imperfection();
  EXPECT_TRUE(MessageDifferencer::Equals(back, expected)) << back.DebugString();
  const auto checked = translate::check_case(given);
  EXPECT_THAT(fields_of(checked.response), IsEmpty());
  EXPECT_THAT(checked.response.modelled(),
              Contains(HasSubstr("turned by 30 degrees; sizes graded; cut at the outline")));
}

TEST(Translate, ANetworkWithTooLongListsIsRefused) {
  v1::Case given = network_case();
  given.mutable_lattice()->mutable_network()->mutable_rises_mm()->Resize(200'001, 0.0);
  EXPECT_THAT(fields_of(translate::check_case(given).response), ElementsAre("lattice.network.rises_mm"));
}

TEST(Translate, ARigidWallsMissingOrDoubleIdAndPlaceAreProblemsWithTheirPaths) {
  const v1::Case given = frame_case(R"(
    rigid_walls { id: "floor" y_mm: 0 normal_x: 1 }
    rigid_walls { id: "floor" x_mm: 0 y_mm: 0 normal_x: 1 displacement_mm {} }
    rigid_walls { x_mm: 0 y_mm: 0 normal_x: 1 }
    rigid_walls { id: "a/b" x_mm: 0 y_mm: 0 normal_x: 1 })");
  EXPECT_THAT(fields_of(translate::to_spec(given).problems),
              ElementsAre("lattice.frame.rigid_walls[0].x_mm", "lattice.frame.rigid_walls[1].id",
                          "lattice.frame.rigid_walls[1].displacement_mm.points", "lattice.frame.rigid_walls[2].id",
                          "lattice.frame.rigid_walls[3].id"));
}

TEST(Translate, WhatAFrameHasAtTwoPlacesIsNamedAsGiven) {
  v1::Case given = frame_case();
  given.mutable_lattice()->mutable_frame()->set_end_time_s(-1.0);
  EXPECT_THAT(fields_of(translate::check_case(given).response), ElementsAre("lattice.frame.end_time_s"));
  given.mutable_lattice()->mutable_frame()->clear_end_time_s();
  EXPECT_THAT(fields_of(translate::check_case(given).response), ElementsAre("lattice.frame.end_time_s"));
  given.mutable_loading()->set_end_time_s(-1.0);
  EXPECT_THAT(fields_of(translate::check_case(given).response), ElementsAre("loading.end_time_s"));
  given.mutable_loading()->set_end_time_s(1e-3);
  EXPECT_THAT(fields_of(translate::check_case(given).response), IsEmpty());
  given.mutable_lattice()->mutable_frame()->set_end_time_s(1e-3);
  const auto twice = translate::check_case(given).response;
  EXPECT_THAT(fields_of(twice), ElementsAre("loading.end_time_s"));
  EXPECT_THAT(twice.problems(0).message(), ::testing::HasSubstr("lattice.frame.end_time_s"));
}

TEST(Translate, IdsThatMeanSomethingInAPathAndDoubleWatchesAreProblems) {
  v1::Case given = frame_case();
  auto& frame = *given.mutable_lattice()->mutable_frame();
  frame.mutable_nodes(0)->set_id("../left");
  frame.add_watched_nodes("right");
  frame.add_watched_nodes("right");
  EXPECT_THAT(fields_of(translate::to_spec(given).problems),
              ::testing::IsSupersetOf({"lattice.frame.nodes[0].id", "lattice.frame.watched_nodes[1]"}));
}

TEST(Translate, ACompletedFrameKeepsItsNodesNames) {
  const v1::Case given = frame_case(R"(
    watched_nodes: "right" rigid_walls { id: "ceiling" x_mm: 0 y_mm: 1000 normal_y: -1 })");
  const auto check = translate::check_case(given);
  ASSERT_THAT(fields_of(check.response), IsEmpty());
  const v1::Frame& frame = check.response.completed_case().lattice().frame();
  EXPECT_EQ(frame.nodes(1).id(), "right");
  EXPECT_EQ(frame.watched_nodes(0), "right");
  EXPECT_EQ(frame.beams(0).end(), "right");
  EXPECT_EQ(frame.rigid_walls(0).id(), "ceiling");
}

TEST(SharedCheckers, KnowTheMeshesOfSmallCasesAndForgetThoseOfLargeOnes) {
  translate::SharedCheckers checkers;
  int built = 0;
  const auto count = [&built](std::int64_t) { ++built; };
  const v1::Case small = testing::small_case();
  const auto first = checkers.check(small, count);
  const auto second = checkers.check(small, count);
  EXPECT_EQ(built, 1);
  EXPECT_GT(first.element_steps, 0);
  EXPECT_EQ(second.element_steps, first.element_steps);
  EXPECT_EQ(second.most_memory_bytes, first.most_memory_bytes);
  v1::Case large = small;
  large.set_title(std::string(5000, 'x'));
  checkers.check(large, count);
  checkers.check(small, count);
  EXPECT_EQ(built, 2);
}

}  // namespace
}  // namespace cellcrush
