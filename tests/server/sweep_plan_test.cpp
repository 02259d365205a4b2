#include "jobs/sweep_plan.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "error.h"
#include "server/small_case.h"

namespace cellcrush::jobs {
namespace {

bool is_never_cancelled() { return false; }

v1::Sweep grid() {
  v1::Sweep sweep;
  *sweep.mutable_case_() = testing::small_case();
  sweep.mutable_case_()->mutable_lattice()->mutable_imperfection()->set_amplitude_mm(0.1);
  sweep.mutable_case_()->mutable_material()->set_density_kg_per_m3(0.5);
  auto& seeds = *sweep.add_axes();
  seeds.set_field("lattice.imperfection.seed");
  seeds.set_seed_count(17);
  return sweep;
}

void add_thicknesses(v1::Sweep& sweep, double last) {
  auto& axis = *sweep.add_axes();
  axis.set_field("lattice.hexagon.wall_thickness_mm");
  axis.mutable_linear()->set_first(0.1);
  axis.mutable_linear()->set_last(last);
  axis.mutable_linear()->set_count(11);
}

std::string text_of(const SweepPlan& plan) {
  std::string out = std::to_string(plan.most_memory_bytes) + " at " + std::to_string(plan.largest) + "\n";
  for (const auto& job : plan.jobs) {
    out += job.job.DebugString() + std::to_string(job.element_steps) + "\n";
    for (const double value : job.values) out += std::to_string(value) + "\n";
  }
  for (const auto& problem : plan.problems) out += problem.DebugString();
  for (const auto& note : plan.notes) out += note.DebugString();
  return out;
}

TEST(SweepPlan, IsTheSameWhateverTheNumberOfThreads) {
  for (const double last : {0.3, 1e3}) {
    MeshPlaces places;
    v1::Sweep sweep = grid();
    add_thicknesses(sweep, last);
    const SweepPlan plan = plan_sweep(sweep, {places, 1, is_never_cancelled});
    EXPECT_EQ(plan.jobs.size(), 187U);
    EXPECT_EQ(plan.problems.empty(), last < 1.0);
    EXPECT_EQ(plan.notes.empty(), last > 1.0);
    for (const int threads : {2, 5, 16}) {
      EXPECT_EQ(text_of(plan_sweep(sweep, {places, threads, is_never_cancelled})), text_of(plan));
    }
  }
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
