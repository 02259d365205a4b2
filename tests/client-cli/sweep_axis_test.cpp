#include "commands/sweep_axis.h"

#include <gtest/gtest.h>

#include "command_error.h"

namespace cellcrush::client {
namespace {

std::string refused_axis(const std::string& text) {
  try {
    parse_axis(text);
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::refused);
    return error.message();
  }
  return {};
}

TEST(SweepAxis, AListHasItsValuesInTheirOrder) {
  const auto axis = parse_axis("loading.speed_m_per_s=50,1e2,-3");
  EXPECT_EQ(axis.field(), "loading.speed_m_per_s");
  ASSERT_EQ(axis.list().values_size(), 3);
  EXPECT_EQ(axis.list().values(1), 100.0);
  EXPECT_EQ(axis.list().values(2), -3.0);
}

TEST(SweepAxis, ARangeHasItsEndsAndItsCount) {
  const auto linear = parse_axis("a=10:200:8");
  EXPECT_EQ(linear.linear().first(), 10.0);
  EXPECT_EQ(linear.linear().last(), 200.0);
  EXPECT_EQ(linear.linear().count(), 8);
  const auto logarithmic = parse_axis("a=0.1:10:3:log");
  EXPECT_EQ(logarithmic.logarithmic().first(), 0.1);
  EXPECT_EQ(logarithmic.logarithmic().last(), 10.0);
  EXPECT_EQ(logarithmic.logarithmic().count(), 3);
}

TEST(SweepAxis, PointsAreThoseOfTheWholeGrid) {
  v1::Sweep sweep;
  for (const char* const axis : {"a=1,2,3", "b=0:1:4", "c=1:10:5:log", "d=seeds:7"})
    *sweep.add_axes() = parse_axis(axis);
  EXPECT_EQ(count_points(sweep), 3.0 * 4.0 * 5.0 * 7.0);
}

TEST(SweepAxis, SeedsAreCounted) { EXPECT_EQ(parse_axis("lattice.imperfection.seed=seeds:20").seed_count(), 20); }

TEST(SweepAxis, WhatIsNoneIsRefusedWithTheForms) {
  for (const char* text : {"a", "=1", "a=1:2", "a=1:2:3:4", "a=1:2:3:log:5"})
    EXPECT_NE(refused_axis(text).find("FIRST:LAST:COUNT"), std::string::npos) << text;
  EXPECT_NE(refused_axis("a=").find("\"\" is not a number"), std::string::npos);
  EXPECT_NE(refused_axis("a=1,,2").find("\"\" is not a number"), std::string::npos);
  EXPECT_NE(refused_axis("a=1:2:2.5").find("\"2.5\" is not an integer"), std::string::npos);
  EXPECT_NE(refused_axis("a=seeds:x").find("\"x\" is not an integer"), std::string::npos);
  EXPECT_NE(refused_axis("a=seeds:99999999999").find("is not an integer"), std::string::npos);
}

}  // namespace
}  // namespace cellcrush::client
