#include "validation/curve_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "validation/course.h"

namespace cellcrush::validation {
namespace {

/// A crush of 100 mm: 2 MPa to 60 % strain, then rising by 100 MPa a unit of strain, with one peak of 3 MPa round 30 %.
std::vector<Sample> crush(double end) {
  std::vector<Sample> samples;
  for (double strain = 0.001; strain < end; strain += 0.001) {
    Sample sample;
    sample.strain = strain;
    sample.travel = 100.0 * strain;
    sample.stress_impact = strain > 0.28 && strain < 0.32 ? 3.0 : 2.0 + 100.0 * std::max(0.0, strain - 0.6);
    sample.stress_support = sample.stress_impact - 0.5;
    sample.energies.residual = -0.25;
    samples.push_back(sample);
  }
  return samples;
}

class CurveFileTest : public testing::Test {
 protected:
  void SetUp() override {
    CurveFile curve(file_);
    for (const Sample& sample : crush(0.8)) {
      curve.add(sample);
    }
  }
  void TearDown() override { std::filesystem::remove(file_); }

  const std::string file_ = testing::TempDir() + "curve-" + std::to_string(getpid());
};

TEST_F(CurveFileTest, GivesBackWhatWasWritten) {
  const auto written = crush(0.8);
  const auto read = read_curve(file_);
  ASSERT_EQ(read.size(), written.size());
  EXPECT_NEAR(read[400].strain, written[400].strain, 1e-6);
  EXPECT_NEAR(read[400].travel, written[400].travel, 1e-4);
  EXPECT_EQ(read[300].stress_impact, 3.0);
  EXPECT_EQ(read[300].stress_support, 2.5);
  EXPECT_EQ(read[300].energies.residual, -0.25);
}

TEST_F(CurveFileTest, LeavesOutARowThatWasCutShort) {
  const std::size_t rows = read_curve(file_).size();
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 3);
  EXPECT_EQ(read_curve(file_).size(), rows - 1);
}

TEST_F(CurveFileTest, RefusesWhatIsNone) {
  std::ofstream(file_) << "strain,stress\n0,1\n";
  EXPECT_THROW(read_curve(file_), std::runtime_error);
  EXPECT_THROW(read_curve(file_ + "-missing"), std::runtime_error);
}

TEST(Course, HasTheOnsetOfDensificationAndThePeaksBeforeIt) {
  const Course course = find_course(crush(0.8));
  EXPECT_TRUE(course.densified);
  EXPECT_NEAR(course.densification, 0.6, 0.01);
  EXPECT_NEAR(course.densification_travel, 60.0, 1.0);
  EXPECT_NEAR(course.plateau, 2.07, 0.02);
  // 2 + 100 x is twice (1.24 + 2 x + 50 x^2) / (0.6 + x) at x = 0.0221.
  EXPECT_TRUE(course.risen);
  EXPECT_NEAR(course.rise_travel, 62.2, 0.2);
  ASSERT_EQ(course.peaks.size(), 1U);
  EXPECT_NEAR(course.peaks[0].strain, 0.3, 0.02);
}

TEST(Course, OfACrushThatHasNotDensifiedEndsWithIt) {
  const Course course = find_course(crush(0.5));
  EXPECT_FALSE(course.densified);
  EXPECT_FALSE(course.risen);
  EXPECT_NEAR(course.densification, 0.499, 0.002);
  EXPECT_TRUE(course_row("name", course).starts_with("name,>0."));
}

}  // namespace
}  // namespace cellcrush::validation
