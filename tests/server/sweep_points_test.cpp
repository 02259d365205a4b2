#include "jobs/sweep_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "error.h"

namespace cellcrush::jobs {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using Values = std::vector<std::vector<double>>;

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
  seeds.set_field("s");
  seeds.set_seed_count(3);
  const auto points = expand(sweep);
  EXPECT_THAT(points.fields, ElementsAre("a", "s"));
  EXPECT_EQ(points.values, (Values{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {2, 3}}));
}

TEST(SweepPoints, RangesMeetTheirEndsAndAreEvenlySpaced) {
  v1::Sweep sweep;
  auto& axis = *sweep.add_axes();
  axis.set_field("a");
  axis.mutable_linear()->set_first(0.1);
  axis.mutable_linear()->set_last(0.7);
  axis.mutable_linear()->set_count(4);
  EXPECT_THAT(expand(sweep).values, ElementsAre(ElementsAre(0.1), ElementsAre(DoubleNear(0.3, 1e-15)),
                                                ElementsAre(DoubleNear(0.5, 1e-15)), ElementsAre(0.7)));
  axis.mutable_logarithmic()->set_first(1.0);
  axis.mutable_logarithmic()->set_last(1000.0);
  axis.mutable_logarithmic()->set_count(4);
  EXPECT_THAT(expand(sweep).values, ElementsAre(ElementsAre(1.0), ElementsAre(DoubleNear(10.0, 1e-12)),
                                                ElementsAre(DoubleNear(100.0, 1e-12)), ElementsAre(1000.0)));
}

TEST(SweepPoints, WholeNumbersEvenlySpacedAreWhole) {
  v1::Sweep sweep;
  auto& axis = *sweep.add_axes();
  axis.set_field("lattice.hexagon.rows");
  axis.mutable_linear()->set_first(1.0);
  axis.mutable_linear()->set_last(1000.0);
  axis.mutable_linear()->set_count(1000);
  const auto points = expand(sweep);
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
  v1::Sweep sweep;
  EXPECT_EQ(refused_field(sweep), "sweep.axes");
  auto& axis = *sweep.add_axes();
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].field");
  axis.set_field("a");
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0]");
  axis.mutable_list();
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].list");
  axis.mutable_linear()->set_count(1);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].linear.count");
  axis.mutable_linear()->set_count(100'001);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].linear.count");
  axis.mutable_linear()->set_count(2);
  axis.mutable_linear()->set_last(std::numeric_limits<double>::infinity());
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].linear");
  axis.mutable_logarithmic()->set_count(2);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].logarithmic");
  axis.set_seed_count(-1);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].seed_count");
  axis.set_seed_count(1000);
  add_list(sweep, "a", {1.0});
  EXPECT_EQ(refused_field(sweep), "sweep.axes[1].field");
  sweep.mutable_axes(1)->set_field("b");
  sweep.mutable_axes(1)->set_seed_count(101);
  EXPECT_EQ(refused_field(sweep), "sweep.axes") << "101000 points";
  sweep.mutable_axes(1)->set_seed_count(100);
  EXPECT_EQ(expand(sweep).values.size(), kMostPoints);
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
    auto& axis = add_list(sweep, field, std::vector<double>(kMostPoints, 1.0 / 3.0));
    axis.set_with_previous(sweep.axes_size() > 1);
  }
  EXPECT_EQ(expand(sweep).values.size(), kMostPoints);
  constexpr std::size_t kLongestName = 17;
  EXPECT_LT(sweep.ByteSizeLong() + kMostPoints * kLongestName, 4'190'000U);
}

}  // namespace
}  // namespace cellcrush::jobs
