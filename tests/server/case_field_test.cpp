#include "jobs/case_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>

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

}  // namespace
}  // namespace cellcrush::jobs
