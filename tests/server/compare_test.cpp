// A user's own test, read from a file and held against a computed curve.
#include "compare/compare_test.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "compare/curve_difference.h"
#include "compare/force_curve.h"
#include "error.h"

namespace cellcrush::compare {
namespace {

using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;

const Specimen kSpecimen{50.0, 200.0};
constexpr CurveKind kStress = CurveKind::stress_strain;

std::string refusal_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

LoadCurve read(const std::string& text, const std::string& columns = "") {
  return read_measurement(text, "test.csv", columns, kSpecimen).curve;
}

void expect_curve(const LoadCurve& curve) {
  EXPECT_THAT(curve.x, Pointwise(DoubleNear(1e-12), {0.0, 0.1, 0.2}));
  EXPECT_THAT(curve.y, Pointwise(DoubleNear(1e-12), {0.0, 2.0, 1.5}));
}

// The same test as machines and people write it.
TEST(Measurement, IsReadInTheUnitsOfItsHeader) {
  expect_curve(read("strain,stress_MPa\n0,0\n0.1,2\n0.2,1.5\n"));
  expect_curve(read("Strain (%),Stress [kPa]\n0,0\n10,2000\n20,1500\n"));
  expect_curve(read("displacement (mm);force (N)\n0;0\n5;400\n10;300\n"));
  expect_curve(read("Weg / mm;Kraft / kN\n0,0;0,0\n5,0;0,4\n10,0;0,3\n"));
  expect_curve(read("\xef\xbb\xbfTime\tExtension\tLoad\r\n(s)\t(mm)\t(kN)\r\n0\t0\t0\r\n1\t5\t0.4\r\n2\t10\t0.3\r\n"));
  expect_curve(read("# machine 3\n\ndisplacement mm,force N\n0,0\n-5,-400\n-10,-300\n"));
  expect_curve(read("strain mm/mm,stress N/mm2\n0,0\n0.1,2\n0.2,1.5\n"));
}

TEST(Measurement, IsReadByColumnsThatTheUserNames) {
  expect_curve(read("0,0,0\n1,5,400\n2,10,300\n", "-, displacement mm, force N"));
  expect_curve(read("a,b\n0,0\n10,2\n20,1.5\n", "strain %,stress MPa"));
}

// Unloading is no part of a loading curve.
TEST(Measurement, EndsAtItsGreatestStrain) {
  const auto curve = read("strain,stress MPa\n0,0\n0.1,2\n0.09,1.9\n0.2,1.5\n0.1,0\n0,0\n");
  expect_curve(curve);
  EXPECT_NEAR(curve.at(0.05), 1.0, 1e-12);
  EXPECT_NEAR(curve.at(0.15), 1.75, 1e-12);
  EXPECT_NEAR(curve.at(0.2), 1.5, 1e-12);
}

TEST(Measurement, WhatCannotBeReadIsNamedWithTheRemedy) {
  const auto refusal = [](const std::string& text, const std::string& columns = "") {
    return refusal_of([&] { static_cast<void>(read(text, columns)); });
  };
  EXPECT_THAT(refusal("a,b\n0,0\n1,1\n2,2\n"),
              HasSubstr("tests has test.csv, which has no column that is strain or displacement"));
  EXPECT_THAT(refusal("a,b\n0,0\n1,1\n2,2\n"), HasSubstr("\"displacement mm, force N\""));
  EXPECT_THAT(refusal("strain,b\n0,0\n1,1\n2,2\n"), HasSubstr("no column that is stress or force"));
  EXPECT_THAT(refusal("0,0\n1,1\n2,2\n"), HasSubstr("has no header"));
  EXPECT_THAT(refusal("strain,stroke mm,force N\n0,0,0\n1,1,1\n2,2,2\n"), HasSubstr("in columns 1 and 2 both strain"));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1,x\n0.2,1\n"), HasSubstr("in line 3, column 2 no number: \"x\""));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1\n0.2,1\n"), HasSubstr("in line 3 only 1 columns"));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1,1\n"), HasSubstr("has 2 rows"));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n10,1\n20,2\n"), HasSubstr("Its unit may be %"));
  EXPECT_THAT(refusal("displacement mm,force N\n0,0\n10,1\n200,2\n"), HasSubstr("as long as that of the test"));
  EXPECT_THAT(refusal("0,0\n1,1\n2,2\n", "strain furlong, stress MPa, other"),
              HasSubstr("columns has \"other\" without a unit"));
  EXPECT_THAT(refusal(""), HasSubstr("has no rows"));
  EXPECT_THAT(refusal("displacement m,force N\n1e308,1\n1e308,1\n1e308,1\n"), HasSubstr("no number: \"1e308\""));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1,nan\n0.2,1\n"), HasSubstr("line 3, column 2 no number"));
  EXPECT_THAT(refusal("strain,\"stress MPa\"\n0,\"0\"\n0.1,\"999\"\n0.2,\"1,234\"\n"), HasSubstr("\"1,234\""));
  EXPECT_THAT(refusal("strain;stress MPa\n0;0\n0.1;1,2\n0.2;1\n"),
              HasSubstr("decimal points and commas, as in line 3"));
  EXPECT_THAT(refusal(std::string("s\0t", 3)), HasSubstr("as UTF-16 has"));
  EXPECT_THAT(refusal("strain,stress MPa\n0.2,1\n0.1,2\n0,3\n"), HasSubstr("does not get further"));
}

// What would take hours, or the memory of the daemon, is refused at once.
TEST(Measurement, IsRefusedIfItIsHuge) {
  const auto refusal = [](const std::string& text) { return refusal_of([&] { static_cast<void>(read(text)); }); };
  constexpr std::size_t kSize = 3'900'000;
  EXPECT_THAT(refusal("a" + std::string(kSize, ' ') + "b"), HasSubstr("has no column that is strain"));
  EXPECT_THAT(refusal(std::string(kSize, ',')), HasSubstr("has in line 1 more than 1000 columns"));
  EXPECT_THAT(refusal(std::string(kSize, '"')), HasSubstr("has no column that is strain"));
  std::string rows = "strain,stress MPa\n";
  while (rows.size() < kSize) rows += "1,1\n";
  EXPECT_THAT(refusal(rows), HasSubstr("has more than 200000 rows"));
}

// Elastic to 2 at .1, down to 1 at .2, level from there: everything is known in closed form.
LoadCurve model(double factor, double end = 0.6) {
  LoadCurve out;
  for (int i = 0; i <= 6000; ++i) {
    const double strain = 1e-4 * i;
    if (strain > end + 1e-9) break;
    out.x.push_back(strain);
    out.y.push_back(factor * (strain <= 0.1 ? 20.0 * strain : strain <= 0.2 ? 3.0 - 10.0 * strain : 1.0));
  }
  return out;
}

TEST(CurveDifference, HasTheNumbersOfCurvesThatAreKnown) {
  const auto found = compare_curves(kStress, model(1.1), {{"one", model(1.0, 0.5)}}, {});
  EXPECT_NEAR(found.common.from, 0.0, 1e-12);
  EXPECT_NEAR(found.common.to, 0.5, 1e-12);
  EXPECT_NEAR(found.measured.slope.value(), 20.0, 1e-9);
  EXPECT_NEAR(found.measured.peak.value(), 2.0, 1e-12);
  EXPECT_NEAR(found.measured.peak_at.value(), 0.1, 1e-12);
  EXPECT_NEAR(found.measured.mean.value(), 1.0, 1e-9);
  EXPECT_NEAR(found.measured.energy, 0.1 + 0.15 + 0.3, 1e-6);
  EXPECT_NEAR(found.computed.slope.value(), 22.0, 1e-9);
  EXPECT_NEAR(found.computed.energy, 1.1 * 0.55, 1e-6);
  EXPECT_NEAR(found.greatest, 0.2, 1e-9);
  EXPECT_NEAR(found.greatest_at, 0.1, 1e-3);
  // Tenth of the measured stress: the mean square of 20 x to .1, of 3 - 10 x to .2, and of 1 to .5.
  EXPECT_NEAR(found.rms, 0.1 * std::sqrt((0.4 / 3.0 + 0.7 / 3.0 + 0.3) / 0.5), 1e-4);
}

TEST(CurveDifference, RepeatsGiveAMeanAndABand) {
  const auto found = compare_curves(kStress, model(1.0), {{"one", model(0.9)}, {"other", model(1.3, 0.4)}},
                                    {CurveRange{0.1, 0.2}, std::nullopt});
  EXPECT_NEAR(found.common.to, 0.4, 1e-12);
  EXPECT_NEAR(found.measured.mean.value(), 1.1 * 1.5, 1e-3);
  EXPECT_NEAR(found.computed.mean.value(), 1.5, 1e-3);
  ASSERT_EQ(found.x.size(), found.most.size());
  EXPECT_NEAR(found.least.back(), 0.9, 1e-12);
  EXPECT_NEAR(found.most.back(), 1.3, 1e-12);
  EXPECT_NEAR(found.mean.back(), 1.1, 1e-12);
}

TEST(CurveDifference, SaysWhatACurveDoesNotHave) {
  LoadCurve rising;
  for (int i = 0; i <= 10; ++i) {
    rising.x.push_back(0.01 * i);
    rising.y.push_back(1.0 * i);
  }
  const auto found = compare_curves(kStress, rising, {{"one", rising}}, {});
  EXPECT_FALSE(found.measured.peak.has_value());
  EXPECT_FALSE(found.measured.mean.has_value()) << "It ends before the window.";
  EXPECT_NEAR(found.measured.slope.value(), 100.0, 1e-9);
  LoadCurve far = rising;
  for (double& strain : far.x) strain += 1.0;
  EXPECT_THAT(refusal_of([&] {
                compare_curves(kStress, rising, {{"far.csv", far}}, {});
              }),
              HasSubstr("tests has far.csv, whose strain goes from 1 to 1.1"));
}

// Elastic to 1 at .1, then a tenth as steep: no peak, but a knee.
TEST(CurveDifference, HasTheSlopeToTheKneeOfACurveWithoutAPeak) {
  LoadCurve hardening;
  for (int i = 0; i <= 600; ++i) {
    const double strain = 1e-3 * i;
    hardening.x.push_back(strain);
    hardening.y.push_back(strain <= 0.1 ? 10.0 * strain : 0.9 + strain);
  }
  const auto found = compare_curves(kStress, hardening, {{"one", hardening}}, {});
  EXPECT_FALSE(found.measured.peak.has_value());
  EXPECT_NEAR(found.measured.slope.value(), 10.0, 1e-9);
}

// A test that ends on the plateau has the same slope beside a crush that goes on until it densifies.
TEST(CurveDifference, LooksForTheKneeWhereAllCurvesAre) {
  LoadCurve crush;
  for (int i = 0; i <= 800; ++i) {
    const double strain = 1e-3 * i;
    crush.x.push_back(strain);
    crush.y.push_back(strain <= 0.02 ? 50.0 * strain
                                     : 1.0 + 1e-3 * strain + (strain > 0.6 ? 100.0 * (strain - 0.6) : 0.0));
  }
  LoadCurve test;
  for (std::size_t i = 0; i <= 300; ++i) test.add(crush.x[i], crush.y[i]);
  const auto found = compare_curves(kStress, crush, {{"test", test}}, {});
  EXPECT_NEAR(found.measured.slope.value(), 50.0, 1e-6);
  EXPECT_NEAR(found.computed.slope.value(), 50.0, 1e-6);
}

// A press that comes down by 1 mm a sample and bears 10 N/mm, then goes back; two feet bear half of it each.
std::vector<v1::Sample> pressed() {
  std::vector<v1::Sample> out;
  for (int i = 0; i <= 15; ++i) {
    const double way = i <= 10 ? i : 20.0 - i;
    v1::Sample& sample = out.emplace_back();
    auto& wall = *sample.add_rigid_walls();
    wall.set_wall("press");
    wall.set_displacement_mm(way);
    wall.set_normal_force_n(10.0 * way);
    auto& grip = *sample.add_grips();
    grip.set_grip("foot");
    grip.set_force_y_n(-5.0 * way);
    grip.set_displacement_x_mm(-2.0 * way);
    auto& node = *sample.add_watched();
    node.set_node("toe");
    node.set_reaction_y_n(-5.0 * way);
  }
  return out;
}

LoadCurve curve_of(const std::string& force, const std::string& displacement) {
  const ForceParts parts(force, displacement);
  parts.check(pressed().front());
  std::vector<CurvePoint> points;
  for (const auto& sample : pressed()) points.push_back(parts.point_of(sample));
  return loading_of(points);
}

TEST(ForceCurve, IsThatOfThePartsWhichAreNamed) {
  const LoadCurve press = curve_of("press", "press");
  ASSERT_EQ(press.x.size(), 11u) << "without the way back";
  EXPECT_DOUBLE_EQ(press.at(7.5), 75.0);
  LoadCurve feet = curve_of("foot.y+toe.y", "foot.x");
  EXPECT_DOUBLE_EQ(feet.x.back(), 20.0);
  EXPECT_DOUBLE_EQ(feet.y.back(), -100.0);
  align_sign(press, feet);
  EXPECT_DOUBLE_EQ(feet.y.back(), 100.0);
  align_sign(press, feet);
  EXPECT_DOUBLE_EQ(feet.y.back(), 100.0);
}

TEST(ForceCurve, NamesWhatTheJobHas) {
  const auto refusal = [](const std::string& force, const std::string& displacement) {
    return refusal_of([&] { curve_of(force, displacement); });
  };
  EXPECT_THAT(
      refusal("foot", "press"),
      HasSubstr(
          "force_part is \"foot\", which the job does not have. Give one of press, foot.x, toe.x, foot.y, toe.y."));
  EXPECT_THAT(refusal("press+press", "press"), HasSubstr("force_part has \"press\" twice"));
  EXPECT_THAT(refusal("press", "pres"), HasSubstr("displacement_part is \"pres\""));
  EXPECT_THAT(refusal("toe.y", "toe.y"), HasSubstr("has not moved"));
  EXPECT_THAT(refusal_of([] { ForceParts("press", "").check(v1::Sample()); }),
              HasSubstr("has no rigid wall, grip or watched node"));
}

// Of a machine that writes compression as negative, both are turned; a force of both signs keeps its own.
TEST(ForceCurve, OfATestMayBeNegative) {
  const auto both = read_measurement("mm,N\n0,0\n-1,-5\n-2,-8\n", "t.csv", "", std::nullopt).curve;
  EXPECT_THAT(both.x, Pointwise(DoubleNear(1e-12), {0.0, 1.0, 2.0}));
  EXPECT_THAT(both.y, Pointwise(DoubleNear(1e-12), {0.0, 5.0, 8.0}));
  const auto force = read_measurement("mm,N\n0,0\n1,-9\n2,7\n", "t.csv", "", std::nullopt).curve;
  EXPECT_THAT(force.y, Pointwise(DoubleNear(1e-12), {0.0, -9.0, 7.0}));
}

TEST(ForceCurve, IsComparedInNewtonsAndMillimetres) {
  const LoadCurve press = curve_of("press", "press");
  const std::string rows = "way mm,load N\n0,0\n-2,15\n-3,22.5\n-6,45\n-12,90\n";
  const auto test = read_measurement(rows, "test.csv", "", std::nullopt);
  const auto found = compare_curves(CurveKind::force_displacement, press, {test}, {CurveRange{2.0, 4.0}, 8.0});
  EXPECT_NEAR(found.measured.slope.value(), 7.5, 1e-9);
  EXPECT_NEAR(found.computed.slope.value(), 10.0, 1e-9);
  EXPECT_NEAR(found.computed.mean.value(), 30.0, 1e-9);
  EXPECT_NEAR(found.measured.energy, 240.0, 1e-9);
  EXPECT_NEAR(found.greatest, 25.0, 1e-9);
  EXPECT_NEAR(found.greatest_at, 10.0, 1e-9);
  EXPECT_THAT(refusal_of([&] {
                compare_curves(CurveKind::force_displacement, press, {test}, {std::nullopt, 20.0});
              }),
              HasSubstr("energy_to is 20 mm; all curves go from 0 to 10 mm"));
  EXPECT_THAT(refusal_of([] { read_measurement("strain,load N\n0,0\n1,1\n2,2\n", "t.csv", "", std::nullopt); }),
              HasSubstr("has t.csv, which has strain or stress, not displacement and force"));
}

}  // namespace
}  // namespace cellcrush::compare
