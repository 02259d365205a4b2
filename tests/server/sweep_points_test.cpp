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
  axis.mutable_linear()->set_count(20'000);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].linear.count");
  axis.mutable_linear()->set_count(2);
  axis.mutable_linear()->set_last(std::numeric_limits<double>::infinity());
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].linear");
  axis.mutable_logarithmic()->set_count(2);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].logarithmic");
  axis.set_seed_count(-1);
  EXPECT_EQ(refused_field(sweep), "sweep.axes[0].seed_count");
  axis.set_seed_count(100);
  add_list(sweep, "a", {1.0});
  EXPECT_EQ(refused_field(sweep), "sweep.axes[1].field");
  sweep.mutable_axes(1)->set_field("b");
  sweep.mutable_axes(1)->set_seed_count(101);
  EXPECT_EQ(refused_field(sweep), "sweep.axes") << "10100 points";
  sweep.mutable_axes(1)->set_seed_count(100);
  EXPECT_EQ(expand(sweep).values.size(), kMostPoints);
}

}  // namespace
}  // namespace cellcrush::jobs
