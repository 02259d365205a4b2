// What is refused of the law of a material: terms without their exponents, tables that define no rising curve, and
// what does not go together.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scene/mesh_part.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

/// A change of a sound material, and the field and words of the only problem that it causes; no field: none.
struct LawChange {
  const char* name;
  std::function<void(SceneSpec&)> change;
  const char* field;
  const char* words;
};

void put_table(SceneSpec& spec, std::vector<double> strains, std::vector<double> stresses) {
  spec.material.yield_stress_mpa = 76.0;
  spec.material.hardening_table = {std::move(strains), std::move(stresses), HardeningTable::Beyond::constant};
}

void put_rates(SceneSpec& spec, std::vector<double> rates, std::vector<double> factors) {
  spec.material.rate_table = {std::move(rates), std::move(factors)};
}

const LawChange kLawChanges[] = {
    {"voce", [](SceneSpec& spec) { spec.material.voce_stress_mpa = 100.0; }, "material.voce_exponent",
     "voce_stress_mpa"},
    {"ludwik", [](SceneSpec& spec) { spec.material.ludwik_stress_mpa = 100.0; }, "material.ludwik_exponent",
     "ludwik_stress_mpa"},
    {"ludwik above 1",
     [](SceneSpec& spec) {
       spec.material.ludwik_stress_mpa = 100.0;
       spec.material.ludwik_exponent = 1.5;
     },
     "material.ludwik_exponent", "too large"},
    {"cowper", [](SceneSpec& spec) { spec.material.cowper_symonds_rate_per_s = 40.0; },
     "material.cowper_symonds_exponent", "cowper_symonds_rate_per_s"},
    {"reference rate", [](SceneSpec& spec) { spec.material.johnson_cook_reference_rate_per_s = 0.0; },
     "material.johnson_cook_reference_rate_per_s", "too small"},
    {"sound table", [](SceneSpec& spec) { put_table(spec, {0.0, 0.1}, {76.0, 90.0}); }, nullptr, nullptr},
    {"one point", [](SceneSpec& spec) { put_table(spec, {0.0}, {76.0}); }, "material.hardening_table.plastic_strains",
     "too few"},
    {"unequal lists", [](SceneSpec& spec) { put_table(spec, {0.0, 0.1}, {76.0}); },
     "material.hardening_table.stresses_mpa", "1 numbers"},
    {"no ascent", [](SceneSpec& spec) { put_table(spec, {0.0, 0.1, 0.1}, {76.0, 80.0, 90.0}); },
     "material.hardening_table.plastic_strains", "ascend"},
    {"softening", [](SceneSpec& spec) { put_table(spec, {0.0, 0.1}, {76.0, 70.0}); },
     "material.hardening_table.stresses_mpa", "fall"},
    {"late start", [](SceneSpec& spec) { put_table(spec, {0.01, 0.1}, {76.0, 80.0}); },
     "material.hardening_table.plastic_strains[0]", "not 0"},
    {"other yield stress", [](SceneSpec& spec) { put_table(spec, {0.0, 0.1}, {77.0, 80.0}); },
     "material.hardening_table.stresses_mpa[0]", "76"},
    {"table and modulus",
     [](SceneSpec& spec) {
       put_table(spec, {0.0, 0.1}, {76.0, 80.0});
       spec.material.hardening_modulus_mpa = 10.0;
     },
     "material.hardening_table", "beside"},
    {"sound rates", [](SceneSpec& spec) { put_rates(spec, {1.0, 100.0}, {1.0, 1.2}); }, nullptr, nullptr},
    {"rate of 0", [](SceneSpec& spec) { put_rates(spec, {0.0, 100.0}, {1.0, 1.2}); },
     "material.rate_table.rates_per_s[0]", "above 0"},
    {"factor above 1", [](SceneSpec& spec) { put_rates(spec, {1.0, 100.0}, {1.1, 1.2}); },
     "material.rate_table.factors[0]", "not 1"},
    {"two laws of the rate",
     [](SceneSpec& spec) {
       put_rates(spec, {1.0, 100.0}, {1.0, 1.2});
       spec.material.johnson_cook_coefficient = 0.01;
     },
     "material.rate_table", "another law"},
    {"quasi-static",
     [](SceneSpec& spec) {
       spec.material.johnson_cook_coefficient = 0.01;
       spec.loading.speed_m_per_s.reset();
       spec.loading.quasi_static = true;
     },
     "loading.quasi_static", "rate"}};

TEST(CheckLaw, NamesTheFieldAndTheRemedy) {
  for (const LawChange& change : kLawChanges) {
    SCOPED_TRACE(change.name);
    SceneSpec spec = scenes::hexagon_specimen(20, 7);
    change.change(spec);
    const Problems problems = build_scene(spec).problems;
    ASSERT_EQ(problems.size(), change.field == nullptr ? 0 : 1) << (problems.empty() ? "" : problems.back().field);
    if (change.field == nullptr) continue;
    EXPECT_EQ(problems.front().field, change.field);
    EXPECT_FALSE(problems.front().remedy.empty());
    EXPECT_NE((problems.front().value + problems.front().message).find(change.words), std::string::npos)
        << problems.front().message;
  }
}

/// In plane strain the stress along the wall is f = 2 / sqrt 3 times the equivalent one, whose plastic strain is f
/// times that along the wall.
TEST(CheckLaw, PlaneStrainMovesEveryCurveToTheStressAlongTheWall) {
  MaterialSpec held = scenes::hexagon_specimen(20, 7).material;
  held.plane = MaterialSpec::Plane::strain;
  held.voce_stress_mpa = 100.0;
  held.voce_exponent = 10.0;
  held.ludwik_stress_mpa = 50.0;
  held.ludwik_exponent = 0.5;
  held.cowper_symonds_rate_per_s = 40.0;
  const double f = 2.0 / std::sqrt(3.0);
  const LawParameters law = material_of(held).law;
  EXPECT_NEAR(law.voce_stress_mpa, 100.0 * f, 1e-9);
  EXPECT_NEAR(law.voce_exponent, 10.0 * f, 1e-9);
  EXPECT_NEAR(law.ludwik_stress_mpa * std::sqrt(0.1), f * 50.0 * std::sqrt(f * 0.1), 1e-9);
  EXPECT_NEAR(law.cowper_symonds_rate_per_s, 40.0 / f, 1e-9);
  held.hardening_table = {{0.0, 0.2}, {100.0, 150.0}, HardeningTable::Beyond::constant};
  const BentLine line = material_of(held).hardening;
  EXPECT_NEAR(line.end, 0.2 / f, 1e-12);
  EXPECT_NEAR(line.bends.front() * line.end, 50.0 * f, 1e-9);
}

}  // namespace
}  // namespace cellcrush
