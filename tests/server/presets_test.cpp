#include "translate/presets.h"

#include <gmock/gmock.h>

#include "cellcrush/fidelity.h"
#include "cellcrush/lattice_words.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "translate/measured_errors.h"
#include "translate/plateau_differences.h"
#include "translate/spec_to_case.h"

namespace cellcrush {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;
using translate::describe_default_mesh;
using translate::describe_small_specimen;
using translate::fields_beside_measured;
using translate::measured_errors_of;
using translate::MeasuredError;

TEST(Presets, AreThoseOfTheSolversTests) {
  const auto& ours = translate::presets();
  ASSERT_EQ(ours.size(), scenes::presets().size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const auto& [name, spec] = scenes::presets()[i];
    EXPECT_EQ(ours[i].message.name(), name);
    EXPECT_EQ(ours[i].spec, spec) << name;
    EXPECT_THAT(ours[i].message.assumptions(), Not(IsEmpty())) << name;
  }
}

// Whatever the registry of lattices lists can be said in a case, and the other way round.
TEST(Lattices, OfTheSolverAreThoseOfTheCase) {
  std::vector<std::string> fields;
  const auto* oneof = v1::Lattice::descriptor()->FindOneofByName("kind");
  for (int i = 0; i < oneof->field_count(); ++i) {
    const std::string name = oneof->field(i)->name();
    if (name == "frame" || name == "network" || name == "voronoi") continue;  // no kinds of equal cells
    fields.push_back(name);
  }
  EXPECT_THAT(lattice_names(), ::testing::UnorderedElementsAreArray(fields));
}

std::vector<v1::FidelityForecast> forecasts_of(const SceneSpec& spec) {
  translate::CaseCheck check;
  translate::add_fidelities(translate::to_case(spec), 1e-7, check);
  return {check.response.fidelities().begin(), check.response.fidelities().end()};
}

std::vector<std::string> measures_of(const std::vector<MeasuredError>& errors) {
  std::vector<std::string> measures;
  for (const MeasuredError& error : errors) measures.push_back(error.measure);
  return measures;
}

TEST(Fidelities, EachIsForecastForTheCaseAtHand) {
  const SceneSpec small = scenes::hexagon_specimen(4, 3);
  const auto forecasts = forecasts_of(small);
  ASSERT_THAT(forecasts, SizeIs(3));
  const std::vector<FidelityPoint> points = fidelity_points(small);
  for (std::size_t i = 0; i < 3; ++i) {
    SceneSpec spec = small;
    spec.elements_per_wall = points[i].elements_per_wall;
    const SceneFacts facts = facts_of(*scenes::build(spec));
    EXPECT_EQ(forecasts[i].element_count(), facts.element_count);
    EXPECT_EQ(forecasts[i].step_count(), facts.step_count);
    EXPECT_THAT(forecasts[i].given_fields(), Not(IsEmpty())) << "four cells are not what was measured";
    EXPECT_THAT(forecasts[i].errors(), IsEmpty());
  }
  EXPECT_THAT(forecasts_of(scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2)), IsEmpty());
}

// A step that two elements a wall can bear and eight cannot.
TEST(Fidelities, OneAtWhichTheCaseCannotRunIsNotForecast) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.numerics.time_step_s = 2e-7;
  const auto forecasts = forecasts_of(spec);
  ASSERT_THAT(forecasts, SizeIs(2));
  EXPECT_EQ(forecasts.back().fidelity(), v1::Numerics::STANDARD);
}

TEST(MeasuredErrors, AreThoseOfTheSpeedsBesideTheCases) {
  SceneSpec spec = scenes::preset("type-i");
  EXPECT_THAT(measures_of(measured_errors_of(spec, 2)),
              ElementsAre("impact plateau, type-i, 100 m/s", "support plateau, type-i, 100 m/s"));
  spec.loading.speed_m_per_s = 90.0;
  EXPECT_THAT(measures_of(measured_errors_of(spec, 2)),
              ElementsAre("impact plateau, type-i, 75 to 100 m/s", "support plateau, type-i, 75 to 100 m/s"));
  for (const double speed : {10.0, 201.0}) {
    spec.loading.speed_m_per_s = speed;
    EXPECT_THAT(fields_beside_measured(spec), ElementsAre("loading.speed_m_per_s"));
  }
  spec.loading.speed_m_per_s = 100.0;
  spec.material.isotropic_fraction = 0.5;
  EXPECT_THAT(fields_beside_measured(spec), IsEmpty()) << "It has no effect without hardening.";
  spec.material.hardening_modulus_mpa = 100.0;
  EXPECT_THAT(fields_beside_measured(spec),
              ElementsAre("material.hardening_modulus_mpa", "material.isotropic_fraction"));
}

TEST(MeasuredErrors, BetweenTwoSpeedsTheLargerCounts) {
  SceneSpec spec = scenes::preset("type-i");
  const auto claimed_at = [&spec](double speed) {
    spec.loading.speed_m_per_s = speed;
    const MeasuredError error = measured_errors_of(spec, 2).back();
    return std::max(error.error, error.uncertainty);
  };
  EXPECT_EQ(claimed_at(90.0), std::max(claimed_at(75.0), claimed_at(100.0)));
}

TEST(MeasuredErrors, OfASpecimenHoldForMoreCellsAndForItsDirection) {
  SceneSpec spec = scenes::preset("type-ii-as-counted");
  for (const int elements : {8, 16, 32}) {
    const std::vector<MeasuredError> errors = measured_errors_of(spec, elements);
    ASSERT_THAT(errors, SizeIs(2));
    EXPECT_EQ(errors[0].measure, "impact plateau, 18 x 9 cells of type-ii-as-counted, 100 m/s");
  }
  scenes::cells_of(spec).columns = 17;
  EXPECT_THAT(fields_beside_measured(spec), ElementsAre("lattice.square.columns"));
  EXPECT_THAT(measured_errors_of(spec, 8), IsEmpty());
  spec = scenes::preset("type-i");
  spec.loading.direction = LoadingSpec::Direction::y;
  EXPECT_EQ(measured_errors_of(spec, 2).at(1).measure, "support plateau, 18 x 21 cells of type-i along y, 100 m/s");
}

TEST(MeasuredErrors, NoneIsToldOfWhatWasNotMeasured) {
  SceneSpec spec = scenes::preset("type-i");
  spec.loading.speed_m_per_s = 5.0;
  spec.material.hardening_modulus_mpa = 100.0;
  scenes::cells_of(spec).wall_thickness_mm = 0.2;
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  spec.numerics.rotary_scaling = 3.0;
  EXPECT_THAT(fields_beside_measured(spec),
              UnorderedElementsAre("lattice.hexagon.wall_thickness_mm", "material.hardening_modulus_mpa",
                                   "loading.speed_m_per_s", "section.depth_rule", "numerics.rotary_scaling"));
}

TEST(MeasuredErrors, NoneIsToldWhereAnyFieldThatMovesThePlateauDiffers) {
  const auto field_beside = [](const auto& change) {
    SceneSpec spec = scenes::preset("type-i");
    change(spec);
    const std::vector<std::string> fields = fields_beside_measured(spec);
    return fields.size() == 1 ? fields.front() : std::to_string(fields.size()) + " fields";
  };
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.loading.end_strain = 0.3; }), "loading.end_strain");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.loading.end_time_s = 1e-4; }), "loading.end_time_s");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.loading.ramp_strain = 0.3; }), "loading.ramp_strain");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.numerics.mass_damping_per_s = 5000.0; }),
            "numerics.mass_damping_per_s");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.numerics.time_step_s = 3.5e-7; }), "numerics.time_step_s");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.material.plane = MaterialSpec::Plane::strain; }), "material.plane");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.imperfection.amplitude_mm = 0.4; }),
            "lattice.imperfection.amplitude_mm");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.imperfection.bow_mm = 0.1; }), "lattice.imperfection.bow_mm");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.contact.friction = 0.1; }), "contact.friction");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.contact.stiffness_factor = 0.02; }), "contact.stiffness_factor");
  EXPECT_EQ(field_beside([](SceneSpec& spec) { spec.loads.rigid_walls.emplace_back(); }), "loading.rigid_walls");
}

TEST(MeasuredErrors, HoldWhateverNamesDividesOrStoresACrush) {
  SceneSpec spec = scenes::preset("type-i");
  spec.title = "Another";
  spec.depth_mm = 7.0;
  spec.elements_per_wall = 4;
  spec.imperfection = {0.01, 8};
  spec.loading.end_strain = 0.45;
  spec.material.poissons_ratio = 0.3;
  spec.numerics.threads = 2;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.section.axial_points = 4;
  spec.output.sample_count = 20;
  EXPECT_THAT(fields_beside_measured(spec), IsEmpty());
}

// A mesh that the case itself gives and that was measured has its error too; another has none.
TEST(MeasuredErrors, AMeshThatIsGivenHasTheErrorOfThatMesh) {
  const SceneSpec spec = scenes::preset("type-i");
  EXPECT_THAT(measured_errors_of(spec, 4), Not(IsEmpty()));
  EXPECT_THAT(measured_errors_of(spec, 3), IsEmpty());
}

TEST(SmallSpecimens, AreToldWithTheirCellsAndWhatWasMeasured) {
  SceneSpec spec = scenes::preset("type-ii-as-counted");
  EXPECT_EQ(describe_small_specimen(spec), "");
  scenes::cells_of(spec).columns = 100;
  EXPECT_EQ(describe_small_specimen(spec), "");
  scenes::cells_of(spec).rows = 17;
  const std::string told = describe_small_specimen(spec);
  EXPECT_THAT(told,
              StartsWith("Small specimen: 100 x 17 cells; the preset type-ii-as-counted has 73 x 18 cells. 18 x 9 "
                         "cells of the latter, crushed along X at 25 to 200 m/s, had mean plateaus"));
  EXPECT_THAT(told,
              ContainsRegex("impact plateau by up to [-+][0-9]+ ± [0-9]+ % \\([0-9]+ m/s\\), support plateau by"));
  EXPECT_THAT(told, Not(HasSubstr("Fewer cells")));
  scenes::cells_of(spec).columns = 12;
  EXPECT_THAT(describe_small_specimen(spec), EndsWith("Fewer cells were not measured."));
}

TEST(DefaultMeshes, AreToldOfEveryKindWithWhatWasMeasured) {
  SceneSpec spec = scenes::preset("zheng-2005");
  const auto is_told =
      AllOf(StartsWith("Default mesh: such lattices of relative density 0."), HasSubstr("crushed along"),
            ContainsRegex("impact plateau by up to [-+][0-9]+ ± [0-9]+ % \\([0-9]+ m/s\\), support"));
  EXPECT_THAT(describe_default_mesh(spec, 0.1), is_told);
  for (const std::string& name : lattice_names()) {
    spec.lattice = RegularLattice{name, {}, {}, {}, {}, {}};
    EXPECT_THAT(describe_default_mesh(spec, 0.1), is_told) << name;
  }
  EXPECT_THAT(describe_default_mesh(scenes::preset("type-i"), 0.1), HasSubstr("relative density 0.1, crushed along X"));
  EXPECT_THAT(describe_default_mesh(scenes::preset("type-i"), 0.01), HasSubstr("relative density 0.0"));
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  EXPECT_EQ(describe_default_mesh(spec, 0.1), "");
  spec = scenes::preset("zheng-2005");
  spec.lattice = NetworkWalls();
  EXPECT_EQ(describe_default_mesh(spec, 0.1), "") << "networks were not measured";
  EXPECT_EQ(describe_default_mesh(scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2), 0.1), "");
}

TEST(SmallSpecimens, OfALatticeWithoutMeasuredDifferencesClaimNone) {
  SceneSpec spec = scenes::preset("type-i");
  EXPECT_EQ(describe_small_specimen(spec), "");
  scenes::cells_of(spec).rows = 20;
  EXPECT_THAT(describe_small_specimen(spec), AllOf(HasSubstr("74 x 20 cells"), EndsWith("was not measured.")));
  EXPECT_EQ(describe_small_specimen(scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2)), "");
}

}  // namespace
}  // namespace cellcrush
