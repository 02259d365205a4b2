#include "jobs/case_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "error.h"
#include "server/small_case.h"

namespace cellcrush::jobs {
namespace {

using ::testing::HasSubstr;

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

TEST(CaseField, NumbersOfAllKindsAreSet) {
  v1::Case target = testing::small_case();
  set_case_field(target, "loading.speed_m_per_s", 12.5);
  set_case_field(target, "lattice.hexagon.rows", 7.0);
  set_case_field(target, "lattice.imperfection.seed", 9007199254740992.0);
  set_case_field(target, "depth_mm", 3.0);
  set_case_field(target, "plates.friction", 0.1);
  EXPECT_EQ(target.loading().speed_m_per_s(), 12.5);
  EXPECT_EQ(target.lattice().hexagon().rows(), 7);
  EXPECT_EQ(target.lattice().imperfection().seed(), 9007199254740992U);
  EXPECT_EQ(target.depth_mm(), 3.0);
  EXPECT_EQ(target.plates().friction(), 0.1);
}

TEST(CaseField, APartOfAListIsNamedByItsPosition) {
  v1::Case target;
  for (int i = 0; i < 2; ++i) target.mutable_lattice()->mutable_frame()->add_nodes()->set_x_mm(0.0);
  set_case_field(target, "lattice.frame.nodes[1].x_mm", 4.0);
  EXPECT_EQ(target.lattice().frame().nodes(1).x_mm(), 4.0);
  EXPECT_THROW(set_case_field(target, "lattice.frame.nodes[2].x_mm", 4.0), InvalidField);
  EXPECT_THROW(set_case_field(target, "lattice.frame.nodes.x_mm", 4.0), InvalidField);
  EXPECT_THROW(set_case_field(target, "lattice.frame.nodes[x].x_mm", 4.0), InvalidField);
}

TEST(CaseField, WholeNumbersStayWhole) {
  EXPECT_THAT(refusal_of("lattice.hexagon.rows", 2.5), HasSubstr("is 2.5, which is not a whole number"));
  EXPECT_THAT(refusal_of("lattice.hexagon.rows", 1e10), HasSubstr("in range"));
  EXPECT_THAT(refusal_of("lattice.hexagon.rows", std::numeric_limits<double>::quiet_NaN()), HasSubstr("not a whole"));
  EXPECT_THAT(refusal_of("lattice.imperfection.seed", -1.0), HasSubstr("Use whole numbers from 0."));
  EXPECT_THAT(refusal_of("lattice.imperfection.seed", 18446744073709551616.0), HasSubstr("in range"));
}

TEST(CaseField, WhatIsNoNumberOfTheCaseIsRefusedByName) {
  EXPECT_THAT(refusal_of("loading.sped_m_per_s", 1.0), HasSubstr("speed_m_per_s"));
  EXPECT_THAT(refusal_of("lattice.square.rows", 1.0), HasSubstr("which has hexagon"));
  for (const char* path : {"title", "loading", "loading.direction", "loading.speed_m_per_s.x",
                           "lattice.inclusions.rows", "lattice.frame.self_contact", "", ".", "loading.", "depth_mm[0]"})
    EXPECT_FALSE(refusal_of(path, 1.0).empty()) << path;
}

TEST(CaseField, ValuesAreWrittenAsPeopleDo) {
  EXPECT_EQ(text_of(50.0), "50");
  EXPECT_EQ(text_of(0.3464), "0.3464");
}

}  // namespace
}  // namespace cellcrush::jobs
