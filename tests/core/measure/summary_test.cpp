#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "cellcrush/lattice_moduli.h"
#include "cellcrush/simulation.h"
#include "measure/curve.h"
#include "measure/lasting_rise.h"
#include "measure/theory.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush {
namespace {

/// Samples of a curve with the exact interval means of a stress given by its integral.
std::vector<Sample> samples_of(const std::function<double(double)>& integral, double end, int count) {
  std::vector<Sample> samples;
  for (int i = 1; i <= count; ++i) {
    Sample sample;
    const double before = end * (i - 1) / count;
    sample.strain = end * i / count;
    sample.stress_impact = (integral(sample.strain) - integral(before)) / (sample.strain - before);
    samples.push_back(sample);
  }
  return samples;
}

TEST(Curve, PlateauIsTheMeanOfTheWindowWhateverTheSampling) {
  const auto integral = [](double e) { return e + e * e; };  // stress 1 + 2 e, mean over .2-.4: 1.6
  for (const int count : {80, 97, 1000}) {
    const Curve curve(samples_of(integral, 0.8, count), &Sample::stress_impact);
    EXPECT_NEAR(*curve.mean(0.2, 0.4), 1.6, 1e-3) << count;
  }
}

TEST(Curve, PlateauIsAbsentBeforeTheWindowIsFull) {
  const Curve curve(samples_of([](double e) { return e; }, 0.39, 100), &Sample::stress_impact);
  EXPECT_FALSE(curve.mean(0.2, 0.4).has_value());
}

TEST(Curve, SmoothedIsTheMeanOfAWindow) {
  const auto integral = [](double e) { return e * e; };  // stress 2 e
  const Curve curve(samples_of(integral, 0.8, 800), &Sample::stress_impact);
  EXPECT_NEAR(curve.smoothed(0.3, 0.02), 0.6, 1e-9);
  EXPECT_NEAR(curve.smoothed(0.3), 0.6, 1e-9);
}

TEST(Curve, OfBothPlatesIsTheMeanOfTheirStresses) {
  auto samples = samples_of([](double e) { return 3.0 * e; }, 0.5, 100);
  for (Sample& sample : samples) sample.stress_support = 1.0;
  EXPECT_NEAR(*curve_of_both_plates(samples).mean(0.1, 0.4), 2.0, 1e-9);
}

TEST(Theory, TypeIHasGibsonAshbyAndEquation51) {
  const auto scene = scenes::build(scenes::hexagon_specimen(74, 21));
  const Theory theory = facts_of(*scene).theory;
  EXPECT_NEAR(theory.gibson_ashby, 2.0 / 3.0 * 76.0 * 0.0866 * 0.0866, 1e-9);
  const double density = 72.1438e-6 / (512.687 * 128.0 * 4.0);
  EXPECT_NEAR(theory.shock, theory.gibson_ashby + density * 1e10 / theory.densification_strain, 2e-4);
}

TEST(Theory, HasTheElasticModuliAlongTheCrushAndAcrossIt) {
  SceneSpec spec = scenes::hexagon_specimen(8, 8);
  spec.loading.direction = LoadingSpec::Direction::y;
  const auto [along, across] = elastic_moduli_of(spec).value();
  const double squared = 0.0866 * 0.0866;
  const double slender = 4.0 / std::sqrt(3.0) * 69000.0 * 0.0866 * squared;
  EXPECT_NEAR(across.modulus, slender / (1.0 + 3.0 * squared), 1e-6 * slender);
  EXPECT_NEAR(along.modulus * across.poissons_ratio, across.modulus * along.poissons_ratio, 1e-9 * slender)
      << "Maxwell and Betti";
  EXPECT_NEAR(along.poissons_ratio, 1.0, 0.04);
  spec.material.plane = MaterialSpec::Plane::strain;
  spec.material.poissons_ratio = 0.3;
  const ElasticModuli held = elastic_moduli_of(spec).value().along;
  EXPECT_NEAR(held.modulus, along.modulus / 0.91, 1e-9 * slender);
  EXPECT_EQ(held.poissons_ratio, along.poissons_ratio);
  spec.changes.rotation_degrees = 10.0;
  EXPECT_FALSE(elastic_moduli_of(spec)) << "no closed form is known of changed walls";
}

class SummaryTest : public testing::Test {
 protected:
  /// Samples to 60 % strain, both plates at 1 MPa, plastic work growing from 2 % strain on.
  static std::vector<Sample> steady_samples() {
    std::vector<Sample> samples;
    for (int i = 1; i <= 600; ++i) {
      Sample sample;
      sample.strain = 0.001 * i;
      sample.stress_impact = 1.0;
      sample.stress_support = 1.0;
      sample.energies.elastic = 10.0;
      sample.energies.plastic = std::max(0.0, 1000.0 * (sample.strain - 0.02));
      sample.energies.kinetic = 1.0;
      samples.push_back(sample);
    }
    return samples;
  }

  std::shared_ptr<Scene> scene_ = scenes::build(scenes::hexagon_specimen(20, 7));
};

TEST_F(SummaryTest, PlatesAreComparedByTheirMeansBeyondFivePercentOfStrain) {
  std::vector<Sample> samples = steady_samples();
  for (Sample& sample : samples) {
    // A difference that rings cancels in the means; one before 5 % strain does not count; one over 2 % of strain does.
    sample.stress_impact += std::lround(1000.0 * sample.strain) % 2 == 0 ? 0.3 : -0.3;
    if (sample.strain < 0.0495) sample.stress_impact += 5.0;
    if (sample.strain > 0.2005 && sample.strain < 0.2205) sample.stress_impact += 0.2;
  }
  const auto found = summarize(*scene_, samples).quasi_static;
  ASSERT_TRUE(found);
  const double window = 0.2 * 0.02 / 0.05;
  EXPECT_NEAR(found->plate_difference_greatest, window / (1.0 + 0.5 * window), 1e-6);
  const double whole = 0.2 * 0.02 / 0.55;
  EXPECT_NEAR(found->plate_difference, whole / (1.0 + 0.5 * whole), 1e-6);
}

// Both plates at 1 MPa, and no densification: the stroke is the whole run.
TEST_F(SummaryTest, CrushForcesAreThoseOfTheImpactPlateOverTheStroke) {
  std::vector<Sample> samples = steady_samples();
  for (Sample& sample : samples) sample.peak = {4.0, 0.01};
  const auto forces = summarize(*scene_, samples).crush_forces;
  ASSERT_TRUE(forces);
  const double area = scene_->width * scene_->depth;
  EXPECT_NEAR(forces->stroke, 0.6 * scene_->length, 1e-9 * scene_->length);
  EXPECT_NEAR(forces->mean, area, 1e-9 * area);
  EXPECT_NEAR(forces->peak, 4.0 * area, 1e-9 * area);
  EXPECT_NEAR(forces->efficiency(), 0.25, 1e-9);
  const double work = area * 0.6 * scene_->length;
  EXPECT_NEAR(forces->specific_energy, work / scene_->total_mass, 1e-9 * work / scene_->total_mass);
}

TEST_F(SummaryTest, CrushForcesAreAbsentBeforeThePeakIsKnown) {
  EXPECT_FALSE(summarize(*scene_, steady_samples()).crush_forces);
}

TEST_F(SummaryTest, PoissonsRatioIsTheSecantAtTheEndOfThePlateauRange) {
  std::vector<Sample> samples = steady_samples();
  for (Sample& sample : samples) sample.lateral_strain = sample.strain < 0.4005 ? 0.3 * sample.strain : -1.0;
  EXPECT_NEAR(summarize(*scene_, samples).poissons_ratio.value(), 0.3, 1e-12);
  samples.resize(100);
  EXPECT_NEAR(summarize(*scene_, samples).poissons_ratio.value(), 0.3, 1e-12);
}

TEST_F(SummaryTest, LedgerErrorOfARunThatOnlyItsInitialEnergyDrivesIsRelativeToThat) {
  std::vector<Sample> samples(10);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].energies.initial = 100.0;
    samples[i].energies.kinetic = 100.0 - 10.0 * static_cast<double>(i);
    samples[i].energies.plastic = 9.5 * static_cast<double>(i);
    samples[i].energies.residual = 0.5 * static_cast<double>(i);
  }
  EXPECT_NEAR(summarize(*scene_, samples).energy_error_relative, 4.5 / 110.0, 0.005);
}

TEST_F(SummaryTest, KineticEnergyIsHeldAgainstPlasticWorkOnceThatOutweighsTheElastic) {
  // At 5 % strain 30 of plastic work outweigh the 10 of elastic energy.
  EXPECT_NEAR(summarize(*scene_, steady_samples()).quasi_static->kinetic_share, 1.0 / 30.0, 1e-9);
  std::vector<Sample> springy = steady_samples();
  for (Sample& sample : springy) sample.energies.elastic = 100.0;  // outweighed from 12 % strain on
  EXPECT_NEAR(summarize(*scene_, springy).quasi_static->kinetic_share, 1.0 / 101.0, 1e-4);
}

TEST_F(SummaryTest, AShortRunIsNotComparedAtAll) {
  std::vector<Sample> samples = steady_samples();
  samples.resize(95);
  EXPECT_FALSE(summarize(*scene_, samples).quasi_static);
}

TEST_F(SummaryTest, TheCrushModeIsWhatMostLooksSay) {
  std::vector<Sample> samples = steady_samples();
  EXPECT_EQ(summarize(*scene_, samples).crush_mode, CrushMode::none);
  EXPECT_FALSE(summarize(*scene_, samples).crush_mode_strain);
  samples[100].crush_mode = CrushMode::v;
  samples[150].crush_mode = CrushMode::i;
  EXPECT_EQ(summarize(*scene_, samples).crush_mode, CrushMode::v) << "the earlier of equals";
  samples[200].crush_mode = CrushMode::i;
  const Summary summary = summarize(*scene_, samples);
  EXPECT_EQ(summary.crush_mode, CrushMode::i);
  EXPECT_NEAR(*summary.crush_mode_strain, 0.151, 1e-12);
}

TEST_F(SummaryTest, TheTheorysErrorIsItsExcessOverThePlateau) {
  const Summary summary = summarize(*scene_, steady_samples());
  ASSERT_TRUE(summary.shock_error());
  EXPECT_NEAR(*summary.shock_error(), summary.theory.shock - 1.0, 1e-9);
  EXPECT_FALSE(summary.front_shock_error()) << "no sample has a front";
}

TEST_F(SummaryTest, SolidFractionAtDensificationFollowsFromTheStrain) {
  std::vector<Sample> samples = steady_samples();
  for (Sample& sample : samples) {
    if (sample.strain > 0.5) sample.stress_impact = sample.stress_support = 1.0 + 50.0 * (sample.strain - 0.5);
    sample.densest_layer.solid_fraction = 0.5;
    sample.contact_count = static_cast<std::int64_t>(scene_->walls.start.size());
  }
  const Summary summary = summarize(*scene_, samples);
  ASSERT_TRUE(summary.densification_strain && summary.solid_fraction_at_densification);
  EXPECT_FALSE(summary.other_rise);
  EXPECT_NEAR(*summary.solid_fraction_at_densification,
              scene_->solid_area / (scene_->length * scene_->width * (1.0 - *summary.densification_strain)), 1e-12);
}

using Stress = std::function<double(double strain)>;

/// Samples of drawn curves of the two plates, each sample the mean over 20 points of its interval.
std::vector<Sample> drawn(const Stress& impact, const Stress& support, double end, int count = 800) {
  constexpr int kPoints = 20;
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    Sample sample;
    sample.strain = end * (i + 1) / count;
    for (int k = 0; k < kPoints; ++k) {
      const double strain = end * (i + (k + 0.5) / kPoints) / count;
      sample.stress_impact += impact(strain) / kPoints;
      sample.stress_support += support(strain) / kPoints;
    }
    samples.push_back(sample);
  }
  return samples;
}

std::optional<double> onset_of(std::span<const Sample> samples) { return find_onset(curve_of_both_plates(samples)); }

std::optional<double> onset_of(const Stress& both, double end, int count = 800) {
  return onset_of(drawn(both, both, end, count));
}

/// 1 up to `onset`, then rising by 50 a unit of strain: the efficiency is greatest at the onset.
Stress flat_then_steep(double onset) {
  return [onset](double e) { return 1.0 + 50.0 * std::max(0.0, e - onset); };
}

TEST(Densification, IsWhereThePlateauEndsWhateverTheSampling) {
  for (const double onset : {0.45, 0.6, 0.75}) {
    for (const int count : {100, 800, 5000}) {
      const auto found = onset_of(flat_then_steep(onset), onset + 0.05, count);
      ASSERT_TRUE(found) << onset << " " << count;
      EXPECT_NEAR(*found, onset, 0.008) << count;
    }
  }
}

TEST(Densification, OfAHardeningPlateauIsWhereTheEfficiencyIsGreatest) {
  // sigma = 1 + e + 40 (e - 0.5)^3 beyond 0.5, as of foams; its efficiency is greatest where sigma^2 = W sigma'.
  const Stress stress = [](double e) { return 1.0 + e + 40.0 * std::pow(std::max(0.0, e - 0.5), 3.0); };
  double expected = 0.5;
  double work = 0.625;
  const auto slope = [](double e) { return 1.0 + 120.0 * std::pow(e - 0.5, 2.0); };
  for (; stress(expected) * stress(expected) > work * slope(expected); expected += 1e-4)
    work += 1e-4 * stress(expected + 5e-5);
  const auto found = onset_of(stress, 0.9);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, expected, 0.01);
}

TEST(Densification, IsNotTheDipAfterTheFirstWave) {
  const Stress stress = [](double e) {
    if (e < 0.04) return 3.0;
    if (e > 0.05 && e < 0.07) return 0.05;
    if (e > 0.22 && e < 0.235) return 0.1;
    return flat_then_steep(0.7)(e);
  };
  EXPECT_NEAR(onset_of(stress, 0.8).value_or(0.0), 0.7, 0.01);
  EXPECT_FALSE(onset_of(stress, 0.69));
}

TEST(Densification, IsNotTheCollapseOfALayer) {
  // Layers that bear three times the mean and fall to nothing, as squares do.
  const Stress layers = [](double e) { return std::max(0.0, 1.0 + 2.0 * std::sin(2.0 * std::numbers::pi * e / 0.08)); };
  for (double end = 0.35; end < 0.9; end += 0.01) EXPECT_FALSE(onset_of(layers, end)) << end;
  const Stress then_solid = [layers](double e) { return layers(e) + 100.0 * std::max(0.0, e - 0.8); };
  EXPECT_NEAR(onset_of(then_solid, 0.95).value_or(0.0), 0.8, 0.03);
}

TEST(Densification, OfAFastCrushIsWhenTheFrontArrivesAtTheSupport) {
  const Stress impact = [](double e) { return 12.0 + 2.0 * std::sin(80.0 * e) + 300.0 * std::max(0.0, e - 0.88); };
  const Stress support = [](double e) { return e < 0.85 ? 0.4 : 0.4 + 500.0 * (e - 0.85); };
  EXPECT_NEAR(onset_of(drawn(impact, support, 0.92)).value_or(0.0), 0.85, 0.02);
  EXPECT_FALSE(onset_of(drawn(impact, support, 0.84)));
}

TEST(Densification, IsNotReachedByAPlateauNorByARunThatEndsInARise) {
  EXPECT_FALSE(onset_of([](double) { return 1.0; }, 0.8));
  EXPECT_FALSE(onset_of(flat_then_steep(0.6), 0.61)) << "a rise by a half only at its end";
  EXPECT_FALSE(onset_of([](double) { return 0.0; }, 0.8));
  EXPECT_FALSE(onset_of(flat_then_steep(0.1), 0.19)) << "before the plateau is looked for";
  EXPECT_FALSE(onset_of([](double e) { return std::sin(20.0 * e); }, 0.8)) << "stresses of both signs";
}

TEST(Densification, BeginsWhereTheLatticeIsDense) {
  const Curve curve = curve_of_both_plates(drawn(flat_then_steep(0.6), flat_then_steep(0.6), 0.8));
  const auto dense_from = [&](double strain) { return find_rise(curve, [=](double e) { return e >= strain; }); };
  EXPECT_NEAR(dense_from(0.3)->onset, 0.6, 0.008) << "by the curve";
  EXPECT_NEAR(dense_from(0.7)->onset, 0.7, 0.002);
  EXPECT_TRUE(dense_from(0.7)->is_dense);
  EXPECT_FALSE(dense_from(0.9)->is_dense);
  EXPECT_NEAR(dense_from(0.9)->onset, 0.6, 0.008) << "of the other rise, by the curve";
  EXPECT_FALSE(dense_from(0.9)->has_fallen);
}

TEST(Densification, OfALatticeThatCollapsedBeforeIsTold) {
  const Stress falls = [](double e) { return e > 0.4 && e < 0.5 ? 0.8 : flat_then_steep(0.6)(e); };
  const auto rise = find_rise(curve_of_both_plates(drawn(falls, falls, 0.8)), [](double) { return false; });
  ASSERT_TRUE(rise);
  EXPECT_TRUE(rise->has_fallen);
}

/// Lasting rises of hexagons of 4 mm, by what they are.
struct NamedRise {
  const char* name;
  int columns;
  double slenderness;  // h/L
  double hardening;    // MPa
  LoadingSpec::Direction direction;
  double speed;  // m/s
  double end;
  RiseKind kind;
};
class LastingRiseOfACrush : public testing::TestWithParam<NamedRise> {};

TEST_P(LastingRiseOfACrush, IsDensificationOnlyIfItIsDense) {
  const NamedRise& of = GetParam();
  SceneSpec spec = scenes::hexagon_specimen(of.columns, 7);
  spec.lattice = scenes::hexagons(of.columns, 7, 4.0, 4.0 * of.slenderness, 4.0 * of.slenderness);
  spec.elements_per_wall = 2;
  spec.material.hardening_modulus_mpa = of.hardening;
  spec.imperfection = {.amplitude_mm = 0.01, .seed = 1};
  spec.loading.direction = of.direction;
  spec.loading.speed_m_per_s = of.speed;
  spec.loading.end_strain = of.end;
  const auto scene = scenes::build(spec);
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const auto by_curve = onset_of(samples);
  ASSERT_TRUE(by_curve) << "the curve cannot tell";
  const Summary summary = summarize(*scene, samples);
  ASSERT_NE(summary.densification_strain.has_value(), summary.other_rise.has_value());
  if (of.kind == RiseKind::densification) {
    ASSERT_TRUE(summary.densification_strain);
    EXPECT_NEAR(*summary.densification_strain, *by_curve, 1e-12);
    EXPECT_GE(*summary.solid_fraction_at_densification, kDenseLattice);
    scenes::record_figure(of.name + std::string(": solid fraction at densification"),
                          *summary.solid_fraction_at_densification, 2);
    return;
  }
  ASSERT_TRUE(summary.other_rise);
  EXPECT_EQ(summary.other_rise->kind, of.kind);
  EXPECT_NEAR(summary.other_rise->strain, *by_curve, 1e-12);
  EXPECT_FALSE(summary.plateau_stress_to_densification);
  const auto at = std::ranges::lower_bound(samples, *by_curve, {}, &Sample::strain);
  scenes::record_figure(of.name + std::string(": contacts per wall at the rise"),
                        static_cast<double>(at->contact_count) / static_cast<double>(scene->walls.start.size()), 2);
  scenes::record_figure(of.name + std::string(": solid fraction at the rise"), at->solid_fraction, 2);
}

INSTANTIATE_TEST_SUITE_P(Of, LastingRiseOfACrush,
                         testing::Values(NamedRise{"thick hexagons", 20, 0.0866, 0.0, LoadingSpec::Direction::y, 10.0,
                                                   0.86, RiseKind::densification},
                                         NamedRise{"hardening hexagons", 12, 0.05, 6900.0, LoadingSpec::Direction::x,
                                                   20.0, 0.8, RiseKind::hardening},
                                         NamedRise{"thin hexagons", 12, 0.02, 0.0, LoadingSpec::Direction::y, 10.0, 0.8,
                                                   RiseKind::second_collapse}),
                         [](const testing::TestParamInfo<NamedRise>& of) {
                           const std::string name = of.param.name;
                           return name.substr(0, name.find(' '));
                         });

TEST(LastingRise, WithoutHardeningAndCollapseIsStiffening) {
  SceneSpec spec = scenes::hexagon_specimen(12, 7);
  std::vector<Sample> samples = drawn(flat_then_steep(0.6), flat_then_steep(0.6), 0.8);
  for (Sample& sample : samples) sample.densest_layer.solid_fraction = 0.5;  // dense, but no walls touch
  EXPECT_EQ(find_lasting_rise(*scenes::build(spec), samples)->kind, RiseKind::stiffening);
  spec.material.hardening_modulus_mpa = 690.0;
  EXPECT_EQ(find_lasting_rise(*scenes::build(spec), samples)->kind, RiseKind::hardening);
  for (Sample& sample : samples) sample.contact_count = 1000;
  EXPECT_EQ(find_lasting_rise(*scenes::build(spec), samples)->kind, RiseKind::densification);
  for (Sample& sample : samples) sample.densest_layer.solid_fraction = 0.14;
  EXPECT_EQ(find_lasting_rise(*scenes::build(spec), samples)->kind, RiseKind::hardening) << "no layer is dense";
}

/// A crush of a small specimen.
struct SmallCrush {
  LoadingSpec::Direction direction;
  double speed;  // m/s
};
class DensificationOfACrush : public testing::TestWithParam<SmallCrush> {};

TEST_P(DensificationOfACrush, IsFoundOnceTheSupportBearsThePlateauToo) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.loading.direction = GetParam().direction;
  spec.loading.speed_m_per_s = GetParam().speed;
  spec.loading.end_strain = 0.92;
  const auto samples = scenes::run_frame(spec);
  const auto onset = onset_of(samples);
  ASSERT_TRUE(onset);
  EXPECT_GT(*onset, 0.6);
  EXPECT_LT(*onset, 0.9);
  const Curve support(samples, &Sample::stress_support);
  const Curve impact(samples, &Sample::stress_impact);
  EXPECT_GT(support.smoothed(0.914), *impact.mean(0.2, *onset)) << "The front has arrived.";
  std::vector<Sample> shorter = samples;
  std::erase_if(shorter, [&](const Sample& sample) { return sample.strain > *onset - 0.03; });
  EXPECT_FALSE(onset_of(shorter));
}

INSTANTIATE_TEST_SUITE_P(
    Of, DensificationOfACrush,
    testing::Values(SmallCrush{LoadingSpec::Direction::x, 10.0}, SmallCrush{LoadingSpec::Direction::x, 100.0},
                    SmallCrush{LoadingSpec::Direction::x, 150.0}, SmallCrush{LoadingSpec::Direction::y, 10.0},
                    SmallCrush{LoadingSpec::Direction::y, 100.0}, SmallCrush{LoadingSpec::Direction::y, 125.0}));

}  // namespace
}  // namespace cellcrush
