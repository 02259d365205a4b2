#include <gmock/gmock.h>

#include <chrono>
#include <limits>
#include <map>
#include <stdexcept>

#include "programs/text_proto.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "translate/check_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class CasesServiceTest : public DaemonFixture {
 protected:
  v1::CheckCaseResponse check(const v1::Case& submitted) {
    v1::CheckCaseRequest request;
    *request.mutable_case_() = submitted;
    return answer_of(*client().cases, &v1::Cases::Stub::CheckCase, request);
  }
};

TEST_F(CasesServiceTest, ACheckNamesAllProblemsAtOnce) {
  v1::Case bad = small_case();
  bad.mutable_lattice()->mutable_hexagon()->set_wall_thickness_mm(-0.1);
  bad.mutable_material()->set_yield_stress_mpa(std::numeric_limits<double>::quiet_NaN());
  bad.mutable_loading()->set_speed_m_per_s(0.0);
  bad.mutable_loading()->set_direction(static_cast<v1::Loading::Direction>(9));
  bad.clear_depth_mm();
  const auto response = check(bad);
  std::vector<std::string> fields;
  for (const auto& problem : response.problems()) {
    fields.push_back(problem.field());
    EXPECT_FALSE(problem.message().empty());
    EXPECT_FALSE(problem.remedy().empty());
  }
  EXPECT_THAT(fields, IsSupersetOf({"lattice.hexagon.wall_thickness_mm", "material.yield_stress_mpa",
                                    "loading.speed_m_per_s", "loading.direction", "depth_mm"}));
  EXPECT_EQ(response.particle_count(), 0);
}

TEST_F(CasesServiceTest, WhatIsHardlyMeantIsNotedByACheckAndByTheJob) {
  auto submitted = small_case();
  EXPECT_EQ(check(submitted).notes_size(), 0);
  submitted.mutable_material()->set_density_kg_per_m3(2.7);
  const auto response = check(submitted);
  EXPECT_EQ(response.problems_size(), 0) << "It can be run.";
  ASSERT_EQ(response.notes_size(), 1);
  EXPECT_EQ(response.notes(0).field(), "material.density_kg_per_m3");
  EXPECT_EQ(response.notes(0).kind(), v1::Problem::IMPLAUSIBLE);
  EXPECT_EQ(client().create(job_of(submitted)).notes_size(), 1);
}

TEST_F(CasesServiceTest, ABeamThatCostsManyStepsIsNotedUnlessItIsARigidLink) {
  auto submitted = small_case();
  submitted.mutable_loading()->set_end_time_s(1e-6);
  submitted.mutable_loading()->clear_speed_m_per_s();
  submitted.mutable_loading()->clear_end_strain();
  *submitted.mutable_lattice() = from_text<v1::Lattice>(R"(frame {
    nodes { id: "a" x_mm: 0 y_mm: 0 } nodes { id: "b" x_mm: 20 y_mm: 0 }
    nodes { id: "c" x_mm: 20.02 y_mm: 0 } nodes { id: "d" x_mm: 40 y_mm: 0 }
    beams { start: "a" end: "b" thickness_mm: 0.5 }
    beams { start: "b" end: "c" thickness_mm: 0.5 }
    beams { start: "c" end: "d" thickness_mm: 0.5 }
  })");
  EXPECT_EQ(check(submitted).notes_size(), 0);
  submitted.mutable_numerics()->set_rigid_link_slenderness(0.0);
  const auto response = check(submitted);
  ASSERT_EQ(response.notes_size(), 1) << response.DebugString();
  EXPECT_EQ(response.notes(0).field(), "lattice.frame.beams[1]");
  EXPECT_THAT(response.notes(0).message(), HasSubstr("sets the time step"));
  const auto created = client().create(job_of(submitted));
  ASSERT_EQ(created.notes_size(), 1);
  EXPECT_EQ(created.notes(0).SerializeAsString(), response.notes(0).SerializeAsString());
}

TEST_F(CasesServiceTest, ASoundCaseIsDescribed) {
  const auto response = check(small_case());
  EXPECT_EQ(response.problems_size(), 0);
  EXPECT_GT(response.particle_count(), 100);
  EXPECT_GT(response.element_count(), response.particle_count());
  EXPECT_GT(response.step_count(), 100);
  EXPECT_GT(response.predicted_seconds(), 0.0);
  EXPECT_LT(response.predicted_seconds(), 60.0);
  EXPECT_GT(response.predicted_bytes(), 10'000);
  EXPECT_EQ(response.completed_case().elements_per_wall(), 2);
  EXPECT_GT(response.theory().shock_mpa(), response.theory().gibson_ashby_mpa());
  EXPECT_GT(response.theory().modulus_mpa(), 0.0);
  EXPECT_NEAR(response.theory().modulus_mpa() * response.theory().poissons_ratio_across(),
              response.theory().modulus_across_mpa() * response.theory().poissons_ratio(), 1e-6);
}

TEST_F(CasesServiceTest, APreviewHasTheMeshThatARunWouldHave) {
  v1::PreviewCaseRequest request;
  *request.mutable_case_() = small_case();
  const auto preview = answer_of(*client().cases, &v1::Cases::Stub::PreviewCase, request);
  const auto facts = check(small_case());
  EXPECT_EQ(preview.mesh().particle_count(), facts.particle_count());
  EXPECT_EQ(preview.mesh().position_mm_size(), 2 * facts.particle_count());
  EXPECT_EQ(preview.mesh().element_nodes_size(), 2 * facts.element_count());
  EXPECT_EQ(preview.mesh().length_mm(), facts.length_mm());
  auto client = this->client();
  const std::string job = client.create(small_case());
  const auto watched = client.watch(job);
  ASSERT_TRUE(watched.status.ok());
  int meshes = 0;
  for (const auto& event : watched.events) {
    if (!event.has_mesh()) continue;
    ++meshes;
    EXPECT_EQ(event.mesh().mesh().SerializeAsString(), preview.mesh().SerializeAsString());
  }
  EXPECT_EQ(meshes, 1);
}

TEST_F(CasesServiceTest, APreviewOfABadOrHugeCaseIsRefused) {
  v1::PreviewCaseRequest request;
  *request.mutable_case_() = with_text(small_case(), "lattice { hexagon { columns: 300 rows: 300 } }");
  const auto huge = try_call(*client().cases, &v1::Cases::Stub::PreviewCase, request);
  EXPECT_THAT(huge, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "fewer cells"));
  request.mutable_case_()->set_depth_mm(-1.0);
  const auto bad = try_call(*client().cases, &v1::Cases::Stub::PreviewCase, request);
  EXPECT_THAT(bad, Fails(grpc::StatusCode::INVALID_ARGUMENT, "depth_mm"));
}

TEST_F(CasesServiceTest, APreviewOfANetworkMarksItsFaults) {
  v1::PreviewCaseRequest request;
  *request.mutable_case_() = small_case();
  v1::Lattice::Network& network = *request.mutable_case_()->mutable_lattice()->mutable_network();
  // A square with a loose end, and a wall across two of its sides, without joints there.
  for (const double number : {0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0, 3.0, 3.0, 4.0, -2.0, 4.0, 12.0}) {
    network.add_joints_mm(number);
  }
  for (const int joint : {0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 5, 6}) network.add_walls(joint);
  network.set_wall_thickness_mm(0.1);
  const auto preview = answer_of(*client().cases, &v1::Cases::Stub::PreviewCase, request);
  std::map<v1::LatticeMarks::Kind, int> counts;
  for (const auto& marks : preview.marks()) counts[marks.kind()] = marks.count();
  EXPECT_EQ(counts[v1::LatticeMarks::LOOSE_END], 3);
  EXPECT_EQ(counts[v1::LatticeMarks::ISLAND], 1);
  EXPECT_EQ(counts[v1::LatticeMarks::CROSSING], 2);
  ASSERT_GT(preview.problems_size(), 0);
  EXPECT_THAT(preview.problems(0).field(), HasSubstr("lattice.network.walls"));
  EXPECT_GT(preview.mesh().support_plate_mm(), preview.mesh().impact_plate_mm());
}

TEST_F(CasesServiceTest, ADrawingIsImportedOrRefusedWithWhatIsWrong) {
  v1::ImportLatticeRequest request;
  auto& file = *request.add_files();
  file.set_name("cross.csv");
  file.set_content("x1,y1,x2,y2\n0,0,10,10\n0,10,10,0\n");
  request.set_thickness_mm(0.1);
  const auto unitless = try_call(*client().cases, &v1::Cases::Stub::ImportLattice, request);
  EXPECT_THAT(unitless, Fails(grpc::StatusCode::INVALID_ARGUMENT, "does not tell its unit"));
  request.set_unit("cm");
  const auto drawn = answer_of(*client().cases, &v1::Cases::Stub::ImportLattice, request);
  EXPECT_EQ(drawn.network().walls_size(), 8);
  EXPECT_EQ(drawn.report().marks(0).words(), "1 crossing of walls");
  EXPECT_EQ(drawn.report().marks(0).places_mm(0), 50.0);
  file.set_content(std::string(4'000'001, '#'));
  const auto large = try_call(*client().cases, &v1::Cases::Stub::ImportLattice, request);
  EXPECT_THAT(large, Fails(grpc::StatusCode::INVALID_ARGUMENT, "files"));
}

// A preset that would give what a fidelity fills in could not be run at one.
TEST_F(CasesServiceTest, APresetTakesItsFidelitysElements) {
  auto preset = client().preset("hexagon-small");
  preset.mutable_numerics()->set_fidelity(v1::Numerics::REFERENCE);
  const auto response = check(preset);
  ASSERT_EQ(response.fidelities_size(), 3);
  EXPECT_EQ(response.completed_case().elements_per_wall(), response.fidelities(2).elements_per_wall());
  EXPECT_EQ(response.fidelities(2).elements_per_wall(), 8);
}

TEST_F(CasesServiceTest, AMeasuredCaseHasItsErrorsAndAnotherTheFieldsThatDiffer) {
  auto preset = client().preset("type-i");
  const auto measured = check(preset).fidelities(1);
  ASSERT_EQ(measured.errors_size(), 2);
  EXPECT_EQ(measured.errors(1).measure(), "support plateau, type-i, 100 m/s");
  EXPECT_GT(measured.errors(1).uncertainty_relative(), 0.0);
  preset.mutable_loading()->set_speed_m_per_s(5.0);
  const auto unknown = check(preset).fidelities(1);
  EXPECT_EQ(unknown.errors_size(), 0);
  ASSERT_EQ(unknown.given_fields_size(), 1);
  EXPECT_EQ(unknown.given_fields(0), "loading.speed_m_per_s");
}

TEST_F(CasesServiceTest, ALatticeThatWasNotMeasuredHasCostsAndNoErrors) {
  for (const char* name : {"zheng-2005", "gibson-1982-reentrant"}) {
    const auto response = check(client().preset(name));
    ASSERT_EQ(response.fidelities_size(), 3) << name;
    EXPECT_EQ(response.predicted_seconds(), response.fidelities(1).predicted_seconds());
    EXPECT_EQ(response.fidelities(1).errors_size(), 0);
    EXPECT_GT(response.fidelities(1).given_fields_size(), 0);
    EXPECT_NE(response.default_mesh(), "");
  }
}

TEST_F(CasesServiceTest, PresetsAreListedAndEachIsSound) {
  auto client = this->client();
  const auto listed = answer_of(*client.cases, &v1::Cases::Stub::ListPresets, {});
  ASSERT_GE(listed.presets_size(), 1);
  for (const auto& preset : listed.presets()) {
    const auto got = answer_of(*client.cases, &v1::Cases::Stub::GetPreset, named<v1::GetPresetRequest>(preset.name()));
    EXPECT_TRUE(got.has_case_()) << preset.name();
    EXPECT_EQ(got.title(), preset.title());
  }
}

TEST_F(CasesServiceTest, LargeChecksThatWereAbandonedLeaveTheirPlace) {
  v1::CheckCaseRequest request;
  *request.mutable_case_() = with_text(small_case(), "lattice { hexagon { columns: 300 rows: 300 } }");
  auto client = this->client();
  v1::CheckCaseResponse out;
  for (int i = 0; i < 8; ++i) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(20));
    (void)client.cases->CheckCase(&context, request, &out);
  }
  const auto status = client.cases->CheckCase(bounded_context().get(), request, &out);
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_GT(out.predicted_memory_bytes(), 64 << 20) << "or it is not large";
}

TEST(CheckCase, IsLeftBetweenStages) {
  for (int stages = 1; stages <= 4; ++stages) {
    int left = stages;
    const auto give_up = [&left] {
      if (--left == 0) throw std::runtime_error("nobody waits");
    };
    EXPECT_THROW(translate::check_case(small_case(), give_up), std::runtime_error) << stages;
  }
}

TEST_F(CasesServiceTest, AMessageOverFourMebibytesIsRefusedAndTheDaemonGoesOn) {
  v1::CheckCaseRequest request;
  request.mutable_case_()->set_title(std::string(5 * 1024 * 1024, 'x'));
  const auto status = try_call(*client().cases, &v1::Cases::Stub::CheckCase, request);
  EXPECT_THAT(status, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "4194304"));
  EXPECT_EQ(check(small_case()).problems_size(), 0);
}

}  // namespace
}  // namespace cellcrush::testing
