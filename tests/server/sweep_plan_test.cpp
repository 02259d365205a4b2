// From axes and points to the jobs of a sweep.
#include "jobs/sweep_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "error.h"
#include "jobs/case_field.h"
#include "jobs/sweep_points.h"
#include "programs/text_proto.h"
#include "server/small_case.h"

namespace cellcrush::jobs {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Values = std::vector<std::vector<double>>;

std::string refusal_of(const std::string& path, double value) {
  v1::Case target = testing::small_case();
  try {
    set_case_field(target, path, value);
  } catch (const InvalidField& refused) {
    EXPECT_EQ(refused.field(), path);
    return refused.what();
  }
  return "";
}

TEST(CaseField, NumbersOfAllKindsAndPartsOfListsAreSet) {
  v1::Case target = testing::small_case();
  set_case_field(target, "loading.speed_m_per_s", 12.5);
  set_case_field(target, "lattice.hexagon.rows", 7.0);
  set_case_field(target, "lattice.imperfection.seed", 9007199254740992.0);
  EXPECT_EQ(target.loading().speed_m_per_s(), 12.5);
  EXPECT_EQ(target.lattice().hexagon().rows(), 7);
  EXPECT_EQ(target.lattice().imperfection().seed(), 9007199254740992U);
  for (int i = 0; i < 2; ++i) target.mutable_lattice()->mutable_frame()->add_nodes()->set_x_mm(0.0);
  set_case_field(target, "lattice.frame.nodes[1].x_mm", 4.0);
  EXPECT_EQ(target.lattice().frame().nodes(1).x_mm(), 4.0);
  for (const char* path : {"lattice.frame.nodes[2].x_mm", "lattice.frame.nodes.x_mm", "lattice.frame.nodes[x].x_mm"})
    EXPECT_THROW(set_case_field(target, path, 4.0), InvalidField) << path;
  auto& network = *target.mutable_lattice()->mutable_network();
  network.mutable_thicknesses_mm()->Resize(3, 0.1);
  network.add_walls(0);
  set_case_field(target, "lattice.network.thicknesses_mm[2]", 0.3);
  set_case_field(target, "lattice.network.walls[0]", 2.0);
  EXPECT_EQ(network.thicknesses_mm(2), 0.3);
  EXPECT_EQ(network.walls(0), 2);
  for (const char* path : {"lattice.network.thicknesses_mm[3]", "lattice.network.thicknesses_mm"})
    EXPECT_THROW(set_case_field(target, path, 4.0), InvalidField) << path;
  EXPECT_THROW(set_case_field(target, "lattice.network.walls[0]", 2.5), InvalidField);
}

TEST(CaseField, WhatIsNoNumberOfTheCaseOrNotInRangeIsRefusedByName) {
  using Field = std::pair<const char*, double>;
  for (const auto& [field, words] :
       {std::pair{Field("lattice.hexagon.rows", 1e10), "in range"},
        std::pair{Field("lattice.hexagon.rows", std::numeric_limits<double>::quiet_NaN()), "not a whole"},
        std::pair{Field("lattice.imperfection.seed", -1.0), "Use whole numbers from 0."},
        std::pair{Field("lattice.imperfection.seed", 18446744073709551616.0), "in range"},
        std::pair{Field("loading.sped_m_per_s", 1.0), "speed_m_per_s"},
        std::pair{Field("lattice.square.rows", 1.0), "which has hexagon"}})
    EXPECT_THAT(refusal_of(field.first, field.second), HasSubstr(words)) << field.first;
  for (const char* path : {"title", "loading", "loading.direction", "loading.speed_m_per_s.x",
                           "lattice.inclusions.rows", "lattice.frame.self_contact", "", ".", "loading.", "depth_mm[0]"})
    EXPECT_FALSE(refusal_of(path, 1.0).empty()) << path;
}

v1::SweepAxis& add_list(v1::Sweep& sweep, const std::string& field, const std::vector<double>& values) {
  auto& axis = *sweep.add_axes();
  axis.set_field(field);
  axis.mutable_list()->mutable_values()->Add(values.begin(), values.end());
  return axis;
}

std::string refused_field(const v1::Sweep& sweep) {
  try {
    expand(sweep);
  } catch (const InvalidField& refused) {
    EXPECT_FALSE(refused.remedy().empty());
    return refused.field();
  }
  return "";
}

TEST(SweepPoints, AGridHasEveryCombinationAndTheLastAxisChangesFastest) {
  v1::Sweep sweep;
  add_list(sweep, "a", {1.0, 2.0});
  auto& seeds = *sweep.add_axes();
  seeds.set_field("lattice.imperfection.seed");
  seeds.set_seed_count(3);
  const auto points = expand(sweep);
  EXPECT_THAT(points.fields, ElementsAre("a", "lattice.imperfection.seed"));
  EXPECT_EQ(points.values, (Values{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {2, 3}}));
}

v1::Sweep over(const std::string& axes) { return testing::from_text<v1::Sweep>(axes); }

TEST(SweepPoints, RangesMeetTheirEndsAreEvenlySpacedAndWholeWhereTheStepIs) {
  EXPECT_THAT(expand(over(R"(axes { field: "a" linear { first: 0.1 last: 0.7 count: 4 } })")).values,
              ElementsAre(ElementsAre(0.1), ElementsAre(DoubleNear(0.3, 1e-15)), ElementsAre(DoubleNear(0.5, 1e-15)),
                          ElementsAre(0.7)));
  EXPECT_THAT(expand(over(R"(axes { field: "a" logarithmic { first: 1 last: 1000 count: 4 } })")).values,
              ElementsAre(ElementsAre(1.0), ElementsAre(DoubleNear(10.0, 1e-12)), ElementsAre(DoubleNear(100.0, 1e-12)),
                          ElementsAre(1000.0)));
  const auto points =
      expand(over(R"(axes { field: "lattice.hexagon.rows" linear { first: 1 last: 1000 count: 1000 } })"));
  for (int i = 0; i < 1000; ++i) EXPECT_THAT(points.values[i], ElementsAre(i + 1.0));
}

TEST(SweepPoints, ListedPointsKeepTheirOrder) {
  v1::Sweep sweep;
  for (const double value : {3.0, 1.0}) {
    auto& fields = *sweep.add_points()->mutable_fields();
    fields["b"] = value;
    fields["a"] = 10.0 * value;
  }
  const auto points = expand(sweep);
  EXPECT_THAT(points.fields, ElementsAre("a", "b"));
  EXPECT_EQ(points.values, (Values{{30, 3}, {10, 1}}));
  (*sweep.add_points()->mutable_fields())["b"] = 1.0;
  EXPECT_EQ(refused_field(sweep), "sweep.points[2].fields");
  add_list(sweep, "a", {1.0});
  EXPECT_EQ(refused_field(sweep), "sweep.points");
}

TEST(SweepPoints, WhatCannotBeASweepIsRefusedByField) {
  for (const auto& [axes, field] :
       {std::pair{"", "sweep.axes"},
        {"axes {}", "sweep.axes[0].field"},
        {"axes { field: 'a' }", "sweep.axes[0]"},
        {"axes { field: 'a' list {} }", "sweep.axes[0].list"},
        {"axes { field: 'a' linear { count: 1 } }", "sweep.axes[0].linear.count"},
        {"axes { field: 'a' linear { count: 100001 } }", "sweep.axes[0].linear.count"},
        {"axes { field: 'a' linear { count: 2 last: inf } }", "sweep.axes[0].linear"},
        {"axes { field: 'a' logarithmic { count: 2 } }", "sweep.axes[0].logarithmic"},
        {"axes { field: 'lattice.imperfection.seed' seed_count: -1 }", "sweep.axes[0].seed_count"},
        {"axes { field: 'loading.speed_m_per_s' seed_count: 3 }", "sweep.axes[0].seed_count"},
        {"axes { field: 'a' list { values: [10, 20, 10] } }", "sweep.axes[0]"},
        {"axes { field: 'a' linear { first: 5 last: 5 count: 2 } }", "sweep.axes[0]"},
        {"axes { field: 'a' list { values: [1, 1, 1] } } axes { field: 'b' list { values: [2, 3, 2] } with_previous: "
         "true }",
         "sweep.axes[0]"},
        {"axes { field: 'a' list { values: 2 } } axes { field: 'a' list { values: 1 } }", "sweep.axes[1].field"},
        {"axes { field: 'lattice.imperfection.seed' seed_count: 1000 }"
         "axes { field: 'b' linear { last: 1 count: 101 } }",
         "sweep.axes"}})
    EXPECT_EQ(refused_field(over(axes)), field) << axes;
  EXPECT_EQ(expand(over("axes { field: 'lattice.imperfection.seed' seed_count: 1000 }"
                        "axes { field: 'b' linear { last: 1 count: 100 } }"))
                .values.size(),
            kMostPoints);
}

TEST(SweepPoints, AValueGivenTwiceIsNamed) {
  try {
    expand(
        over("axes { field: 'depth_mm' list { values: [1, 2, 3] } }"
             "axes { field: 'loading.speed_m_per_s' list { values: [10, 20, 10] } }"));
    ADD_FAILURE();
  } catch (const InvalidField& refused) {
    EXPECT_THAT(refused.message(), HasSubstr("has loading.speed_m_per_s = 10 twice, at the places 1 and 3"));
  }
}

TEST(SweepPoints, AxesThatAdvanceTogetherListPointsAndCombineWithTheOthers) {
  v1::Sweep sweep;
  add_list(sweep, "a", {1.0, 2.0});
  add_list(sweep, "b", {10.0, 20.0}).set_with_previous(true);
  add_list(sweep, "c", {5.0, 6.0});
  const auto points = expand(sweep);
  EXPECT_THAT(points.fields, ElementsAre("a", "b", "c"));
  EXPECT_EQ(points.values, (Values{{1, 10, 5}, {1, 10, 6}, {2, 20, 5}, {2, 20, 6}}));
  sweep.mutable_axes(1)->mutable_list()->add_values(30.0);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[1]") << "3 values beside 2";
  sweep.mutable_axes(0)->set_with_previous(true);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].with_previous");
}

TEST(SweepPoints, AHundredThousandExplicitPointsOfThreeFieldsFitInOneMessage) {
  v1::Sweep sweep;
  for (const char* field : {"loading.speed_m_per_s", "plates.friction", "lattice.hexagon.wall_thickness_mm"}) {
    std::vector<double> values(kMostPoints);
    std::iota(values.begin(), values.end(), 1.0 / 3.0);
    auto& axis = add_list(sweep, field, values);
    axis.set_with_previous(sweep.axes_size() > 1);
  }
  EXPECT_EQ(expand(sweep).values.size(), kMostPoints);
  constexpr std::size_t kLongestName = 17;
  EXPECT_LT(sweep.ByteSizeLong() + kMostPoints * kLongestName, 4'190'000U);
}

bool is_never_cancelled() { return false; }

v1::Sweep grid() {
  v1::Sweep sweep;
  *sweep.mutable_case_() = testing::small_case();
  return testing::with_text(sweep, R"(case { lattice { imperfection { amplitude_mm: 0.1 } }
                                        material { density_kg_per_m3: 0.5 } }
                                 axes { field: "lattice.imperfection.seed" seed_count: 17 })");
}

std::string text_of(const SweepPlan& plan) {
  std::string out = std::to_string(plan.most_memory_bytes) + " at " + std::to_string(plan.largest) + "\n";
  for (const auto& job : plan.jobs) {
    out += job.job().DebugString() + std::to_string(job.element_steps) + "\n";
    for (const double value : job.values) out += std::to_string(value) + "\n";
  }
  for (const auto& problem : plan.problems) out += problem.DebugString();
  for (const auto& note : plan.notes) out += note.DebugString();
  return out;
}

TEST(SweepPlan, IsTheSameWhateverTheNumberOfThreads) {
  for (const double last : {0.3, 1e3}) {
    MeshPlaces places;
    const v1::Sweep sweep = testing::with_text(
        grid(), "axes { field: 'lattice.hexagon.wall_thickness_mm' linear { first: 0.1 count: 11 last: " +
                    std::to_string(last) + " } }");
    const SweepPlan plan = plan_sweep(sweep, {places, 1, is_never_cancelled});
    EXPECT_EQ(plan.jobs.size(), 187U);
    EXPECT_EQ(plan.problems.empty(), last < 1.0);
    EXPECT_EQ(plan.notes.empty(), last > 1.0);
    for (const int threads : {2, 5, 16}) {
      EXPECT_EQ(text_of(plan_sweep(sweep, {places, threads, is_never_cancelled})), text_of(plan));
    }
  }
}

// The default mesh of hexagons crushed along y is finer above 25 m/s.
TEST(SweepPlan, NotesWhereTheDefaultMeshChanges) {
  MeshPlaces places;
  v1::Sweep sweep;
  *sweep.mutable_case_() = testing::small_case();
  sweep.mutable_case_()->mutable_loading()->set_direction(v1::Loading::Y);
  add_list(sweep, "loading.speed_m_per_s", {10.0, 25.0, 50.0});
  const auto notes_of = [&] { return plan_sweep(sweep, {places, 1, is_never_cancelled}).notes; };
  sweep.mutable_case_()->clear_elements_per_wall();
  const auto notes = notes_of();
  ASSERT_EQ(notes.size(), 1);
  EXPECT_EQ(notes[0].field(), "elements_per_wall");
  EXPECT_EQ(notes[0].kind(), v1::Problem::IMPLAUSIBLE);
  EXPECT_THAT(notes[0].message(), HasSubstr("2 at 2 points (first: loading.speed_m_per_s = 10); "
                                            "8 at 1 point (loading.speed_m_per_s = 50)."));
  sweep.mutable_case_()->set_elements_per_wall(2);
  EXPECT_EQ(notes_of().size(), 0);
}

TEST(SweepPlan, KeepsNoJobs) {
  MeshPlaces places;
  const v1::Sweep sweep = testing::with_text(
      grid(), "axes { field: 'lattice.hexagon.wall_thickness_mm' linear { first: 0.1 count: 20 last: 0.3 } }");
  const std::size_t before = mallinfo2().uordblks;
  const SweepPlan plan = plan_sweep(sweep, {places, 1, is_never_cancelled, "cluster"});
  EXPECT_LT(mallinfo2().uordblks, before + 500 * plan.jobs.size());
  EXPECT_EQ(most_points(sweep), 340);
  const v1::Job last = plan.jobs.back().job();
  EXPECT_EQ(last.case_().lattice().imperfection().seed(), 17U);
  EXPECT_EQ(last.case_().lattice().hexagon().wall_thickness_mm(), 0.3);
  EXPECT_EQ(last.executor(), "cluster");
}

// 38 bytes a point and 17 for the name of its job: 80,000 would not fit in a message of 4 MiB.
TEST(SweepPlan, MorePointsThanAMessageHoldsAreRefusedWithTheBytesThatFit) {
  MeshPlaces places;
  v1::Sweep sweep;
  *sweep.mutable_case_() = testing::small_case();
  for (int i = 0; i < 80'000; ++i) (*sweep.add_points()->mutable_fields())["loading.speed_m_per_s"] = 50.0 + 1e-3 * i;
  try {
    plan_sweep(sweep, {places, 1, is_never_cancelled});
    ADD_FAILURE() << "accepted";
  } catch (const InvalidField& refused) {
    EXPECT_EQ(refused.field(), "sweep");
    EXPECT_NE(refused.message().find(std::to_string(sweep.ByteSizeLong()) + " bytes"), std::string::npos);
    EXPECT_NE(refused.remedy().find("2830000 bytes"), std::string::npos) << refused.remedy();
    EXPECT_NE(refused.remedy().find("with_previous"), std::string::npos);
  }
}

TEST(SweepPlan, IsLeftOnceNobodyWaitsForIt) {
  MeshPlaces places;
  std::atomic<int> looks = 0;
  EXPECT_THROW(plan_sweep(grid(), {places, 3, [&looks] { return ++looks > 4; }}), ServiceError);
}

}  // namespace
}  // namespace cellcrush::jobs
