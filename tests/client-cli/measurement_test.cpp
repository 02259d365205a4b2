// A user's own test, read from a file and held against a computed curve.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>

#include "command_error.h"
#include "results/curve_difference.h"

namespace cellcrush::client {
namespace {

using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;

const Specimen kSpecimen{50.0, 200.0};

std::string refusal_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const CommandError& error) {
    return error.message();
  }
  return "";
}

StressCurve read(const std::string& text, const std::string& columns = "") {
  return read_measurement(text, "test.csv", columns, kSpecimen).curve;
}

void expect_curve(const StressCurve& curve) {
  EXPECT_THAT(curve.strain, Pointwise(DoubleNear(1e-12), {0.0, 0.1, 0.2}));
  EXPECT_THAT(curve.stress_mpa, Pointwise(DoubleNear(1e-12), {0.0, 2.0, 1.5}));
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
  EXPECT_THAT(refusal("a,b\n0,0\n1,1\n2,2\n"), HasSubstr("test.csv: no column is strain or displacement"));
  EXPECT_THAT(refusal("a,b\n0,0\n1,1\n2,2\n"), HasSubstr("--columns \"displacement mm, force N\""));
  EXPECT_THAT(refusal("strain,b\n0,0\n1,1\n2,2\n"), HasSubstr("no column is stress or force"));
  EXPECT_THAT(refusal("0,0\n1,1\n2,2\n"), HasSubstr("has no header"));
  EXPECT_THAT(refusal("strain,stroke mm,force N\n0,0,0\n1,1,1\n2,2,2\n"), HasSubstr("columns 1 and 2 are both strain"));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1,x\n0.2,1\n"), HasSubstr("line 3, column 2: \"x\""));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1\n0.2,1\n"), HasSubstr("line 3 has 1 columns"));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n0.1,1\n"), HasSubstr("has 2 rows"));
  EXPECT_THAT(refusal("strain,stress MPa\n0,0\n10,1\n20,2\n"), HasSubstr("Its unit may be %"));
  EXPECT_THAT(refusal("displacement mm,force N\n0,0\n10,1\n200,2\n"), HasSubstr("shorter than that of the test"));
  EXPECT_THAT(refusal("0,0\n1,1\n2,2\n", "strain furlong, stress MPa, other"), HasSubstr("\"other\" without a unit"));
  EXPECT_THAT(refusal(""), HasSubstr("has no rows"));
}

// Elastic to 2 at .1, down to 1 at .2, level from there: everything is known in closed form.
StressCurve model(double factor, double end = 0.6) {
  StressCurve out;
  for (int i = 0; i <= 6000; ++i) {
    const double strain = 1e-4 * i;
    if (strain > end + 1e-9) break;
    out.strain.push_back(strain);
    out.stress_mpa.push_back(factor * (strain <= 0.1 ? 20.0 * strain : strain <= 0.2 ? 3.0 - 10.0 * strain : 1.0));
  }
  return out;
}

TEST(CurveDifference, HasTheNumbersOfCurvesThatAreKnown) {
  const auto found = compare_curves(model(1.1), {{"one", model(1.0, 0.5)}}, std::nullopt);
  EXPECT_NEAR(found.common.from, 0.0, 1e-12);
  EXPECT_NEAR(found.common.to, 0.5, 1e-12);
  EXPECT_NEAR(found.measured.slope_mpa.value(), 20.0, 1e-9);
  EXPECT_NEAR(found.measured.peak_mpa.value(), 2.0, 1e-12);
  EXPECT_NEAR(found.measured.peak_strain.value(), 0.1, 1e-12);
  EXPECT_NEAR(found.measured.mean_mpa.value(), 1.0, 1e-9);
  EXPECT_NEAR(found.measured.energy_mj_per_mm3, 0.1 + 0.15 + 0.3, 1e-6);
  EXPECT_NEAR(found.computed.slope_mpa.value(), 22.0, 1e-9);
  EXPECT_NEAR(found.computed.energy_mj_per_mm3, 1.1 * 0.55, 1e-6);
  EXPECT_NEAR(found.greatest_mpa, 0.2, 1e-9);
  EXPECT_NEAR(found.greatest_strain, 0.1, 1e-3);
  // Tenth of the measured stress: the mean square of 20 x to .1, of 3 - 10 x to .2, and of 1 to .5.
  EXPECT_NEAR(found.rms_mpa, 0.1 * std::sqrt((0.4 / 3.0 + 0.7 / 3.0 + 0.3) / 0.5), 1e-4);
}

TEST(CurveDifference, RepeatsGiveAMeanAndABand) {
  const auto found =
      compare_curves(model(1.0), {{"one", model(0.9)}, {"other", model(1.3, 0.4)}}, StrainRange{0.1, 0.2});
  EXPECT_NEAR(found.common.to, 0.4, 1e-12);
  EXPECT_NEAR(found.measured.mean_mpa.value(), 1.1 * 1.5, 1e-3);
  EXPECT_NEAR(found.computed.mean_mpa.value(), 1.5, 1e-3);
  ASSERT_EQ(found.strain.size(), found.most_mpa.size());
  EXPECT_NEAR(found.least_mpa.back(), 0.9, 1e-12);
  EXPECT_NEAR(found.most_mpa.back(), 1.3, 1e-12);
  EXPECT_NEAR(found.mean_mpa.back(), 1.1, 1e-12);
}

TEST(CurveDifference, SaysWhatACurveDoesNotHave) {
  StressCurve rising;
  for (int i = 0; i <= 10; ++i) {
    rising.strain.push_back(0.01 * i);
    rising.stress_mpa.push_back(1.0 * i);
  }
  const auto found = compare_curves(rising, {{"one", rising}}, std::nullopt);
  EXPECT_FALSE(found.measured.peak_mpa.has_value());
  EXPECT_FALSE(found.measured.mean_mpa.has_value()) << "It ends before the window.";
  EXPECT_NEAR(found.measured.slope_mpa.value(), 100.0, 1e-9);
  EXPECT_THAT(difference_table(found, {{"one", rising}}), HasSubstr("first peak, MPa"));
  StressCurve far = rising;
  for (double& strain : far.strain) strain += 1.0;
  EXPECT_THAT(refusal_of([&] {
                compare_curves(rising, {{"far.csv", far}}, std::nullopt);
              }),
              HasSubstr("far.csv: its strain goes from 1 to 1.1"));
}

}  // namespace
}  // namespace cellcrush::client
